#include "bindings/cli/heed_points.h"

#include <algorithm>
#include <atomic>

#include <fmt/format.h>

#include "bindings/embree/seen_faces.h"
#include "clv/math/hash.h"

namespace clv {
namespace {

constexpr float kSlack = 1.0f / 64.0f;        // of the scene's largest extent, that points may lie outside without a word
constexpr std::size_t kMostLooks = 1024;      // points that look around
constexpr double kStray = 0.005;              // share of them that may face into something solid without a word
constexpr double kMany = 0.05;                // share of them beyond which surfaces are sheets
constexpr int kMostlyBacks = kSeenRays / 2;   // rays that meet backs, at least, and three times as many as meet fronts

void heedPlaces(const Bounds& bounds, std::span<const ClvReceiver> points, std::vector<std::string>& warnings) {
    const vec3 extent = bounds.extent();
    const float slack = kSlack * glm::max(extent.x, glm::max(extent.y, extent.z));
    std::size_t outside = 0;
    float farthest = 0.0f;
    for (const ClvReceiver& point : points) {
        const float away = glm::length(point.position - glm::clamp(point.position, bounds.lo, bounds.hi));
        outside += away > slack;
        farthest = std::max(farthest, away);
    }
    if (outside > 0)
        warnings.push_back(fmt::format("{} of {} points lie outside of the scene's bounds, by up to {:.3g} m: no light is stored there, and they get that of the edge", outside, points.size(), farthest));
}

// The share of the points that face backs.
double shareThatFacesBacks(const EmbreeScene& scene, std::span<const ClvReceiver> points, const ParallelFor& parallelFor) {
    const std::size_t looks = std::min(points.size(), kMostLooks);
    std::atomic<std::size_t> inside = 0;
    parallelFor(looks, [&](std::size_t k) {
        const SeenFaces seen = seenFaces(scene, points[k * points.size() / looks], clvHash(uint(k)));
        inside += seen.backs >= kMostlyBacks && seen.backs > 3 * seen.fronts;
    });
    return double(inside) / double(std::max<std::size_t>(looks, 1));
}

}  // namespace

PointHeed heedPoints(const EmbreeScene& scene, std::span<const ClvReceiver> points, const ParallelFor& parallelFor) {
    PointHeed heed;
    heedPlaces(scene.scene().bounds, points, heed.warnings);
    const double inside = shareThatFacesBacks(scene, points, parallelFor);
    heed.sheets = inside > kMany;
    if (inside > kStray)
        heed.warnings.push_back(fmt::format("{:.1f} % of the points face the backs of surfaces: {}", 100.0 * inside,
                                            heed.sheets ? "nothing counts as solid" : "what is enclosed by backs counts as solid, and what they get is not their own light"));
    return heed;
}

}  // namespace clv
