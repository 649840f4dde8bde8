#include "bindings/scene/motion.h"

#include <cmath>


namespace clv {
namespace {

constexpr double kSteep = 0.999;  // of a view that looks up or down, whose up is not that of the world

bool sameLight(const ClvLight& a, const ClvLight& b) {
    return a.position == b.position && a.direction == b.direction && a.intensity == b.intensity;
}

ClvLight lightAt(const LightMotion& motion, const Scene& scene, double frame) {
    ClvLight light = scene.lights[motion.light].light;
    if (const auto position = motion.position.at(frame)) light.position = glm::vec3(*position - scene.anchor);
    if (const auto intensity = motion.intensity.at(frame)) light.intensity = glm::vec3(*intensity);
    // Half way between opposite directions there is none: the light keeps its own.
    if (const auto direction = motion.direction.at(frame); direction && glm::length(*direction) > 1e-6) light.direction = glm::vec3(glm::normalize(*direction));
    return light;
}

}  // namespace

std::vector<NamedLight> lightsAt(const Motion& motion, const Scene& scene, std::uint32_t frame) {
    std::vector<NamedLight> lights = scene.lights;
    for (const LightMotion& moving : motion.lights) {
        ClvLight& light = lights[moving.light].light;
        light = lightAt(moving, scene, frame);
        light.dynamicity = frame > 0 && !sameLight(light, lightAt(moving, scene, frame - 1.0)) ? 1.0f : 0.0f;
    }
    return lights;
}

Camera cameraAt(const Motion& motion, const Scene& scene, const Camera& otherwise, std::uint32_t frame) {
    if (!motion.camera) return otherwise;
    const glm::dvec3 before = scene.anchor + glm::dvec3(otherwise.position);
    const glm::dvec3 position = motion.camera->position.at(frame).value_or(before);
    const glm::dvec3 target = motion.camera->target.at(frame).value_or(position + glm::dvec3(otherwise.forward));
    Camera camera = otherwise;
    camera.position = glm::vec3(position - scene.anchor);
    camera.yfov = float(motion.camera->yfov.at(frame).value_or(double(otherwise.yfov)));
    // A camera that passes through its target looks on as it did.
    if (!(glm::distance(position, target) > 1e-9)) return camera;
    const glm::dvec3 forward = glm::normalize(target - position);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, std::abs(forward.y) > kSteep ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0)));
    camera.forward = glm::vec3(forward);
    camera.up = glm::vec3(glm::cross(right, forward));
    return camera;
}

}  // namespace clv
