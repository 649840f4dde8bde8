#include "bindings/cli/heed_points.h"

#include <algorithm>
#include <atomic>

#include <fmt/format.h>

#include "bindings/embree/path_tracer.h"

namespace clv {
namespace {

constexpr float kSlack = 1.0f / 64.0f;        // of the scene's largest extent, that points may lie outside without a word
constexpr double kStray = 0.02;               // share of them that may face into something solid without a word
constexpr double kMany = 0.05;                // share of them that face lit backs, beyond which surfaces are sheets
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

// Shares of the points that face backs, and of those whose surroundings there are lit by a lamp.
struct Facing {
    double backs = 0.0, litBacks = 0.0;
};
Facing facing(const EmbreeScene& scene, std::span<const Look> looks, const ParallelFor& parallelFor) {
    std::atomic<std::size_t> backs = 0, litBacks = 0;
    parallelFor(looks.size(), [&](std::size_t k) {
        const Look& look = looks[k];
        if (look.faces.backs < kMostlyBacks || look.faces.backs <= 3 * look.faces.fronts) return;
        ++backs;
        bool lit = false;
        seenFaces(scene, look.point, look.seed, [&](const vec3& position, const ClvHit& hit) { lit = lit || directIrradiance(scene, position, hit.normal) != vec3(0.0f); });
        litBacks += lit;
    });
    return {double(backs) / double(looks.size()), double(litBacks) / double(looks.size())};
}

}  // namespace

PointHeed heedPoints(const EmbreeScene& scene, std::span<const ClvReceiver> points, std::span<const Look> looks, bool sheets,
                      const ParallelFor& parallelFor) {
    PointHeed heed{.warnings = {}, .sheets = sheets};
    heedPlaces(scene.scene().bounds, points, heed.warnings);
    if (points.empty() || sheets) return heed;
    const Facing share = facing(scene, looks, parallelFor);
    heed.sheets = share.litBacks > kMany;
    if (share.backs > kStray)
        heed.warnings.push_back(fmt::format("{:.1f} % of the points face the backs of surfaces: {}", 100.0 * share.backs,
                                            heed.sheets ? "light is in there, and nothing counts as solid" : "what is enclosed by backs counts as solid, and what they get is not their own light"));
    return heed;
}

}  // namespace clv
