#include "bindings/cli/surroundings.h"

#include <algorithm>

#include "bindings/embree/seen_faces.h"
#include "clv/math/hash.h"

namespace clv {
namespace {

constexpr std::size_t kMostLooks = 1024;  // points that look around
constexpr std::size_t kSkipped = 4;       // of what a point sees every fourth place looks on

std::size_t looksOf(std::span<const ClvReceiver> points) { return std::min(points.size(), kMostLooks); }

// Calls `look` with the number and the place of each point that looks around.
template <class Look>
void forLooks(std::span<const ClvReceiver> points, const ParallelFor& parallelFor, Look&& look) {
    parallelFor(looksOf(points), [&](std::size_t k) { look(k, points[k * points.size() / looksOf(points)]); });
}

// Element of rank share * size; kClvFar of none.
float quantile(std::vector<float>& values, double share) {
    if (values.empty()) return kClvFar;
    const auto at = values.begin() + std::ptrdiff_t(share * double(values.size()));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

}  // namespace

std::vector<ClvReceiver> receiversOf(std::span<const ReferencePoint> points) {
    std::vector<ClvReceiver> receivers;
    receivers.reserve(points.size());
    for (const ReferencePoint& p : points) receivers.push_back({p.position, 0.0f, p.normal, 0.0f});
    return receivers;
}

float nearSight(const EmbreeScene& scene, std::span<const ClvReceiver> points, const ParallelFor& parallelFor) {
    std::vector<float> middles(looksOf(points));
    forLooks(points, parallelFor, [&](std::size_t k, const ClvReceiver& point) {
        std::vector<float> distances;
        seenFaces(scene, point, clvHash(uint(k)), [&](const vec3&, const ClvHit& hit) { distances.push_back(hit.distance); });
        middles[k] = quantile(distances, 0.5);
    });
    return quantile(middles, 0.25);
}

std::vector<std::uint32_t> viewsOf(const EmbreeScene& scene, std::span<const ClvReceiver> points, const ParallelFor& parallelFor) {
    std::vector<std::vector<std::uint32_t>> seen(looksOf(points));  // triangles
    forLooks(points, parallelFor, [&](std::size_t k, const ClvReceiver& point) {
        std::vector<ClvReceiver> places;
        const auto look = [&](const ClvReceiver& from, std::uint32_t seed) {
            seenFaces(scene, from, seed, [&](const vec3& position, const ClvHit& hit) {
                seen[k].push_back(hit.primitive);
                places.push_back({position, 0.0f, hit.normal, 0.0f});
            });
        };
        look(point, clvHash(uint(k)));  // as nearSight() looks: what it sees is among the views
        // On to what is seen from there: no point sees the surface that it lies on.
        for (std::size_t p = 0, count = places.size(); p < count; p += kSkipped) look(ClvReceiver(places[p]), clvHashCombine(uint(k), uint(p)));
    });
    std::vector<std::uint32_t> views(scene.scene().triangles.size(), 0);
    for (const auto& triangles : seen) {
        for (const std::uint32_t triangle : triangles) ++views[triangle];
    }
    return views;
}

}  // namespace clv
