// Lights and a camera that move: what a motion file says, and where they are at a frame.
#pragma once
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings/scene/scene.h"

namespace clv {

// Values at frames, in their order; linear in between, and those of the ends beyond.
template <class T>
struct Track {
    std::vector<std::pair<double, T>> keys;  // frame, value

    std::optional<T> at(double frame) const {
        if (keys.empty()) return {};
        const auto after = std::ranges::find_if(keys, [frame](const auto& key) { return key.first > frame; });
        if (after == keys.begin()) return keys.front().second;
        if (after == keys.end()) return keys.back().second;
        const auto& [from, a] = *(after - 1);
        const auto& [to, b] = *after;
        return a + (b - a) * ((frame - from) / (to - from));
    }
};

struct LightMotion {
    std::size_t light = 0;  // index into Scene::lights
    Track<glm::dvec3> position, direction, intensity;
};

struct CameraMotion {
    Track<glm::dvec3> position, target;  // m, world space
    Track<double> yfov;                  // rad
};

struct Motion {
    std::string file;                    // where it was read
    double fps = 60.0;                   // frames/s
    std::uint32_t lastFrame = 0;         // of all keys
    std::vector<LightMotion> lights;
    std::optional<CameraMotion> camera;
};

// Reads {"fps":..., "lights":[{"name":..., "keys":[...]}], "camera":{"keys":[...]}} for the lights of a scene. Throws InputError.
Motion loadMotion(const std::string& file, const Scene& scene);

// The lights of the scene at a frame; those that are not as they were the frame before have a dynamicity of 1.
std::vector<NamedLight> lightsAt(const Motion& motion, const Scene& scene, std::uint32_t frame);
// `otherwise` with what the motion says of the camera.
Camera cameraAt(const Motion& motion, const Scene& scene, const Camera& otherwise, std::uint32_t frame);

}  // namespace clv
