// Receivers spread evenly over all surfaces of a scene.
#ifndef CLV_TESTS_FURNACE_SURFACE_POINTS_H
#define CLV_TESTS_FURNACE_SURFACE_POINTS_H
#include <algorithm>
#include <cmath>
#include <vector>

#include "bindings/embree/path_tracer.h"
#include "support/chi_square.h"

namespace clv::test {

inline double triangleArea(const Scene& scene, const glm::uvec3& t) {
    const glm::dvec3 a(scene.positions[t.x]);
    return 0.5 * glm::length(glm::cross(glm::dvec3(scene.positions[t.y]) - a, glm::dvec3(scene.positions[t.z]) - a));
}

inline double surfaceArea(const Scene& scene) {
    double sum = 0.0;
    for (const glm::uvec3& t : scene.triangles) sum += triangleArea(scene, t);
    return sum;
}

// Points that are uniform by area, with normals to the front.
inline std::vector<ReferencePoint> surfacePoints(const Scene& scene, int count, uint seed) {
    std::vector<double> cumulative;
    for (const glm::uvec3& t : scene.triangles) cumulative.push_back((cumulative.empty() ? 0.0 : cumulative.back()) + triangleArea(scene, t));
    std::vector<ReferencePoint> points;
    for (uint i = 0; i < uint(count); ++i) {
        // One point in each slice of equal area.
        const double place = (i + randomUnit(seed, 3 * i)) / count * cumulative.back();
        const std::size_t index = std::min<std::size_t>(std::size_t(std::upper_bound(cumulative.begin(), cumulative.end(), place) - cumulative.begin()),
                                                        scene.triangles.size() - 1);
        const glm::uvec3& t = scene.triangles[index];
        const glm::vec3 a = scene.positions[t.x], e1 = scene.positions[t.y] - a, e2 = scene.positions[t.z] - a;
        const float root = std::sqrt(randomUnit(seed, 3 * i + 1)), v = randomUnit(seed, 3 * i + 2);
        points.push_back({a + e1 * (root * (1.0f - v)) + e2 * (root * v), glm::normalize(glm::cross(e1, e2))});
    }
    return points;
}

}  // namespace clv::test
#endif
