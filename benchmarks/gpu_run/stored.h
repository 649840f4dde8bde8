// What a run on a GPU reads from files: scenes to time, and cases whose results are known from the CPU. A file is written by one
// machine and read by another of the same byte order, by the same commit.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "clv/data/light.h"
#include "clv/plan/light_frame.h"

namespace clv {

struct StoredCamera {
    vec3 position{}, forward{}, up{};  // m, unit length, unit length
    float yfov = 0.0f;                 // rad
};

// A scene as shaders and a walk on the host read it: rows as data/bvh.h and data/surface.h say.
struct StoredScene {
    std::string name{};
    std::vector<vec4> boxes{};
    std::vector<uvec4> children{};
    std::vector<vec4> triangles{}, surfaces{};
    std::vector<ClvLight> lights{};
    vec3 boundsLo{}, boundsHi{};   // m
    float originOffset = 0.0f;     // m; see ClvFrame
    StoredCamera camera{};
};

struct StoredBuffer {
    std::string name;              // of the frame
    std::vector<std::byte> bytes;
};

// What the host reads back from a buffer after all steps, as floats.
struct StoredCheck {
    std::string buffer{};
    std::vector<float> expected{};
    std::vector<float> bounds{};      // how far each may be from what is expected; empty: see largestRmse
    std::uint64_t exceptions = 0;     // numbers that may be further away: of rays that pass an edge on its other side
    float largestRmse = 0.0f;         // of all numbers, relative to their mean
};

// A frame with all that the host gives it, and what must come out, whichever way it injects.
struct StoredCase {
    std::string name{};
    LightFrameSettings settings{};
    std::vector<std::string> steps{};
    std::vector<StoredBuffer> buffers{};  // a frame may not have all of them: ways to inject need different ones
    std::vector<StoredCheck> checks{};
};

// Throw std::runtime_error with one line that names the file.
void writeStored(const std::filesystem::path& file, const StoredScene& scene);
void writeStored(const std::filesystem::path& file, const StoredCase& stored);
StoredScene readStoredScene(const std::filesystem::path& file);
StoredCase readStoredCase(const std::filesystem::path& file);

}  // namespace clv
