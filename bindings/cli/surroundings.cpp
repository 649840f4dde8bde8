#include "bindings/cli/surroundings.h"

#include <algorithm>

#include "clv/math/hash.h"

namespace clv {
namespace {

constexpr std::size_t kMostLooks = 1024;  // points that look around

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

std::vector<Look> lookAround(const EmbreeScene& scene, std::span<const ClvReceiver> points, const ParallelFor& parallelFor) {
    std::vector<Look> looks(std::min(points.size(), kMostLooks));
    parallelFor(looks.size(), [&](std::size_t k) {
        Look& look = looks[k];
        look.point = points[k * points.size() / looks.size()], look.seed = clvHash(uint(k));
        std::vector<float> distances;
        look.faces = seenFaces(scene, look.point, look.seed, [&](const vec3&, const ClvHit& hit) { distances.push_back(hit.distance); });
        look.middle = quantile(distances, 0.5);
    });
    return looks;
}

float nearSight(std::span<const Look> looks) {
    std::vector<float> middles;
    for (const Look& look : looks) middles.push_back(look.middle);
    return quantile(middles, 0.1);
}

}  // namespace clv
