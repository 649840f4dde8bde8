// A light volume at one moment: the grids, what is open in their cells, the light in them, and where it came from.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bindings/scene/scene.h"
#include "clv/cpu/evaluate.h"
#include "clv/cpu/partial_volume.h"
#include "clv/data/cascades.h"

namespace clv {

struct BakedCascade {
    Level level;                                // without scroll: its table is x fastest
    std::vector<std::vector<float>> estimates;  // one or two independent ones: mean deposits, layout.stride() floats a slot, W m
    std::vector<float> samples;                 // a slot: rays, of all that were sent, that its light is the mean of
    std::vector<float> dynamicity;              // kSides a slot, [0, 1]; empty where no light moves
};

// By which a scene is told from another one.
struct SceneMark {
    std::size_t triangles = 0;
    Bounds bounds;                   // m, relative to the anchor
};
SceneMark markOf(const Scene& scene);

struct BakedVolume {
    std::string scene;               // file, or name of a built-in scene
    std::optional<SceneMark> mark;   // of that scene
    std::string libraryVersion;
    glm::dvec3 anchor{0.0};          // m, world space; all positions are relative to it
    std::vector<NamedLight> lights;  // at this moment
    std::optional<Camera> camera;    // that the cascades stand around
    bool allBounces = false;
    std::uint32_t seed = 1;
    std::uint32_t frame = 0;         // from 0, in a series
    DepositLayout layout;
    float marginCells = 0.0f;        // see ClvCascades
    float blendCells = 0.0f;
    std::vector<BakedCascade> cascades;  // finest first; at most kClvMaxCascades
};

ClvCascades cascadesOf(const BakedVolume& volume);

// Bytes of the grids and their light.
std::size_t bytesOf(const BakedVolume& volume);

// Indirect irradiance at a receiver, W/m^2: from the finest cascade that holds it, mixed with the next one near its edge; beyond the
// last cascade the light is that of its edge.
vec3 irradianceAt(const BakedVolume& volume, const ClvReceiver& receiver, const LookupOptions& lookup = {});

// Directions of the six sides, world space, in the order of kSides.
inline constexpr std::array<const char*, kSides> kSideNames{"+x", "-x", "+y", "-y", "+z", "-z"};
vec3 sideNormal(std::size_t side);

// A cell as people look at it: all of its open regions together.
struct CellLight {
    std::array<vec3, kSides> irradiance{};  // W/m^2 on each side
    std::array<float, kSides> variance{};   // (W/m^2)^2 of each side, mean over the channels; 0 from a single estimate
    std::array<float, kSides> dynamicity{}; // [0, 1], the largest of its regions
    float samples = 0.0f;                   // rays, the fewest of its regions
    float openVolume = 0.0f;                // m^3
    uint slots = 0;                         // open regions; 0: solid, and all else is 0
};
CellLight cellLight(const BakedVolume& volume, const BakedCascade& cascade, std::size_t cell);
// The same of one of its regions.
CellLight regionLight(const BakedVolume& volume, const BakedCascade& cascade, uint slot);

}  // namespace clv
