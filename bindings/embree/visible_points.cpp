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

std::vector<VisibleSurface> visibleSurfaces(const EmbreeScene& scene, const Camera& camera, int width, int height,
                                            const ParallelFor& parallelFor) {
    const float tangent = std::tan(0.5f * camera.yfov);
    const glm::vec3 up = tangent * camera.up;
    const glm::vec3 right = tangent * float(width) / float(height) * glm::cross(camera.forward, camera.up);
    std::vector<std::vector<VisibleSurface>> rows{std::size_t(height)};
    parallelFor(rows.size(), [&](std::size_t y) {
        for (int x = 0; x < width; ++x) {
            const float across = 2.0f * (float(x) + 0.5f) / float(width) - 1.0f;
            const float upwards = 1.0f - 2.0f * (float(y) + 0.5f) / float(height);
            const glm::vec3 direction = glm::normalize(camera.forward + across * right + upwards * up);
            const ClvHit hit = scene.hit(camera.position, direction, kClvFar);
            if (hit.distance >= kClvFar) continue;
            const ReferencePoint point{camera.position + hit.distance * direction, hit.normal};
            rows[y].push_back({y * std::size_t(width) + std::size_t(x), point, hit.albedo});
        }
    });
    std::vector<VisibleSurface> surfaces;
    for (const auto& row : rows) surfaces.insert(surfaces.end(), row.begin(), row.end());
    return surfaces;
}

std::vector<ReferencePoint> pointsOf(std::span<const VisibleSurface> surfaces) {
    std::vector<ReferencePoint> points;
    points.reserve(surfaces.size());
    for (const VisibleSurface& surface : surfaces) points.push_back(surface.point);
    return points;
}

}  // namespace clv
