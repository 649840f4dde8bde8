#include "bindings/embree/tight_frame.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace clv {
namespace {

constexpr std::size_t kJudges = 2048;      // triangles, the largest ones, by which frames are compared
constexpr std::size_t kCandidates = 16;    // triangles, the largest ones, that stand upright in a frame of their own
constexpr double kClearGain = 0.9;         // of the cost along the scene's own axes; above it nothing is turned

using Corners = std::array<glm::dvec3, 3>;

// Half the surface of a triangle's box along the axes of `rotation`, m^2.
double boxCost(const Corners& t, const glm::dmat3& rotation) {
    const glm::dvec3 a = rotation * t[0], b = rotation * t[1], c = rotation * t[2];
    const glm::dvec3 extent = glm::max(glm::max(a, b), c) - glm::min(glm::min(a, b), c);
    return extent.x * extent.y + extent.y * extent.z + extent.z * extent.x;
}

}  // namespace

TightFrame findTightFrame(const Scene& scene) {
    std::vector<Corners> triangles;
    triangles.reserve(scene.triangles.size());
    for (const glm::uvec3& t : scene.triangles) triangles.push_back({scene.positions[t.x], scene.positions[t.y], scene.positions[t.z]});
    auto normal = [](const Corners& t) { return glm::cross(t[1] - t[0], t[2] - t[0]); };
    std::vector<std::uint32_t> order(triangles.size());
    std::iota(order.begin(), order.end(), 0u);
    std::vector<double> area(triangles.size());
    for (std::size_t i = 0; i < area.size(); ++i) area[i] = glm::length(normal(triangles[i]));
    const std::size_t judges = std::min(order.size(), kJudges);
    std::partial_sort(order.begin(), order.begin() + std::ptrdiff_t(judges), order.end(),
                      [&](std::uint32_t a, std::uint32_t b) { return area[a] != area[b] ? area[a] > area[b] : a < b; });
    auto cost = [&](const glm::dmat3& rotation) {
        double sum = 0.0;
        for (std::size_t k = 0; k < judges; ++k) sum += boxCost(triangles[order[k]], rotation);
        return sum;
    };

    TightFrame best;
    double least = kClearGain * cost(glm::dmat3(1.0));
    for (std::size_t k = 0; k < std::min(judges, kCandidates); ++k) {
        const Corners& t = triangles[order[k]];
        const glm::dvec3 z = glm::normalize(normal(t));
        // Two of the three edges of half a rectangle are its sides.
        for (int corner = 0; corner < 3; ++corner) {
            const glm::dvec3 x = glm::normalize(t[(corner + 1) % 3] - t[corner]);
            const glm::dmat3 rotation = glm::transpose(glm::dmat3(x, glm::cross(z, x), z));
            if (const double c = cost(rotation); c < least) least = c, best = {scene.bounds.center(), glm::mat3(rotation)};
        }
    }
    return best;
}

}  // namespace clv
