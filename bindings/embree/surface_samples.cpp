#include "bindings/embree/surface_samples.h"

#include <algorithm>
#include <cmath>

#include "clv/math/sobol.h"

namespace clv {

SurfaceSamples sampleSurfaces(const Scene& scene, std::size_t count, std::uint32_t seed) {
    std::vector<double> areas(scene.triangles.size());
    double total = 0.0;
    for (std::size_t t = 0; t < areas.size(); ++t) {
        const glm::uvec3& c = scene.triangles[t];
        const glm::dvec3 a = scene.positions[c.x], b = scene.positions[c.y], d = scene.positions[c.z];
        areas[t] = total += 0.5 * glm::length(glm::cross(b - a, d - a));
    }
    SurfaceSamples samples;
    samples.area = float(total / double(count));
    samples.receivers.reserve(2 * count);
    samples.albedo.reserve(2 * count);
    for (std::size_t k = 0; k < count; ++k) {
        const vec4 u = clvSobol4(uint(k), seed);
        const double at = (double(k) + u.x) / double(count) * total;
        const std::size_t t = std::min<std::size_t>(std::lower_bound(areas.begin(), areas.end(), at) - areas.begin(), areas.size() - 1);
        const glm::uvec3& c = scene.triangles[t];
        // Uniform in a triangle: Turk 1990.
        const float root = std::sqrt(u.y), v1 = root * (1.0f - u.z), v2 = root * u.z;
        const vec3 a = scene.positions[c.x], b = scene.positions[c.y], d = scene.positions[c.z];
        const vec3 normal = glm::normalize(cross(b - a, d - a));
        const vec3 position = a + v1 * (b - a) + v2 * (d - a);
        const vec3 albedo = scene.albedo(std::uint32_t(t), v1, v2);
        for (const vec3& side : {normal, -normal}) {
            samples.receivers.push_back({position, 0.0f, side, 0.0f});
            samples.albedo.push_back(albedo);
        }
    }
    return samples;
}

}  // namespace clv
