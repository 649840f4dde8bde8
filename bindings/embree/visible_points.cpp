#include "bindings/embree/visible_points.h"

#include <cmath>

#include "clv/math/sobol.h"

namespace clv {

std::vector<ClvReceiver> visiblePoints(const EmbreeScene& scene, std::size_t count, std::uint32_t seed) {
    std::vector<ClvReceiver> points;
    const auto& cameras = scene.scene().cameras;
    if (cameras.empty()) return points;
    points.reserve(count);
    // A picture that is mostly sky needs more tries; one that is all sky ends them.
    const std::size_t tries = 16 * count;
    for (std::size_t i = 0; i < tries && points.size() < count; ++i) {
        const Camera& camera = cameras[i % cameras.size()];
        const vec4 u = clvSobol4(uint(i / cameras.size()), clvHashCombine(seed, uint(i % cameras.size())));
        const float tangent = std::tan(0.5f * camera.yfov);
        const vec3 right = cross(camera.forward, camera.up);
        const vec3 direction = glm::normalize(camera.forward + right * ((2 * u.x - 1) * tangent * camera.aspect) + camera.up * ((2 * u.y - 1) * tangent));
        const ClvHit hit = scene.hit(camera.position, direction, kClvFar);
        if (hit.primitive == 0xffffffffu) continue;
        points.push_back({camera.position + direction * hit.distance, 0.0f, hit.normal, 0.0f});
    }
    return points;
}

}  // namespace clv
