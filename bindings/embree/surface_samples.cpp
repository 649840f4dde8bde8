#include "bindings/embree/surface_samples.h"

#include <algorithm>
#include <cmath>

#include "bindings/embree/seen_faces.h"
#include "clv/math/sobol.h"

namespace clv {
namespace {

constexpr std::size_t kPiece = 512;               // points
constexpr int kSightRank = kSeenRays * 3 / 4;     // more than what is seen of two walls in a corner

// The bits of a 10-bit number, two places apart.
std::uint32_t spread(std::uint32_t x) {
    x = (x | x << 16) & 0x030000ffu;
    x = (x | x << 8) & 0x0300f00fu;
    x = (x | x << 4) & 0x030c30c3u;
    return (x | x << 2) & 0x09249249u;
}

// Which way a surface faces, then its place along a Z-order curve through the bounds (Morton 1966).
std::uint64_t placeOf(const vec3& position, const vec3& normal, const Bounds& bounds) {
    const vec3 n = glm::abs(normal);
    const int axis = n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
    const std::uint64_t facing = 2u * std::uint32_t(axis) + (normal[axis] < 0.0f ? 1u : 0u);
    const vec3 at = glm::clamp((position - bounds.lo) / glm::max(bounds.extent(), vec3(1e-30f)), 0.0f, 1.0f) * 1023.0f;
    return facing << 30 | spread(std::uint32_t(at.x)) | spread(std::uint32_t(at.y)) << 1 | spread(std::uint32_t(at.z)) << 2;
}

// Samples that fall on a patch, in proportion, m^2: half by its area and half by its share of the views, which is the same where there are none.
double weightOf(const SurfacePatch& patch, double total) { return 0.5 * (double(patch.area) + total * double(patch.share)); }

}  // namespace

double surfaceArea(const Scene& scene) {
    double area = 0.0;
    for (std::size_t t = 0; t < scene.triangles.size(); ++t) area += 0.5 * double(glm::length(windingNormal(scene, std::uint32_t(t))));
    return area;
}

SurfaceSamples sampleSurfaces(const EmbreeScene& embree, std::size_t count, std::uint32_t seed, const ParallelFor& parallelFor,
                              std::span<const SurfaceView> views) {
    const Scene& scene = embree.scene();
    const std::vector<SurfacePatch> patches = patchesWhereSeen(scene, views);
    double area = 0.0, total = 0.0;
    for (const SurfacePatch& patch : patches) area += double(patch.area);
    std::vector<double> ends;  // sums of weights, m^2
    ends.reserve(patches.size());
    for (const SurfacePatch& patch : patches) ends.push_back(total += weightOf(patch, area));
    SurfaceSamples all;
    all.receivers.resize(2 * count);
    all.albedo.resize(count);
    all.area.resize(count);
    all.sight.resize(2 * count);
    std::vector<std::uint8_t> kept(2 * count);
    parallelFor((count + kPiece - 1) / kPiece, [&](std::size_t piece) {
        for (std::size_t k = piece * kPiece; k < std::min(count, (piece + 1) * kPiece); ++k) {
            const vec4 u = clvSobol4(uint(k), seed);
            const double at = (double(k) + u.x) / double(count) * total;
            const SurfacePatch& patch = patches[std::min<std::size_t>(std::lower_bound(ends.begin(), ends.end(), at) - ends.begin(), ends.size() - 1)];
            const std::uint32_t t = patch.triangle;
            const glm::uvec3& c = scene.triangles[t];
            // Uniform in a triangle: Turk 1990.
            const float root = std::sqrt(u.y), v1 = patch.v1 + patch.size * root * (1.0f - u.z), v2 = patch.v2 + patch.size * root * u.z;
            const vec3 a = scene.positions[c.x], b = scene.positions[c.y], d = scene.positions[c.z];
            const vec3 normal = glm::normalize(windingNormal(scene, t));
            all.albedo[k] = scene.albedo(t, v1, v2);
            all.area[k] = float(total / double(count) * (double(patch.area) / weightOf(patch, area)));
            for (int side = 0; side < 2; ++side) {
                ClvReceiver& receiver = all.receivers[2 * k + side];
                receiver = {a + v1 * (b - a) + v2 * (d - a), 0.0f, side == 0 ? normal : -normal, 0.0f};
                std::vector<float> distances;
                const SeenFaces seen = seenFaces(embree, receiver, clvHashCombine(seed, uint(2 * k + side)),
                                                 [&](const vec3&, const ClvHit& hit) { distances.push_back(hit.distance); });
                distances.resize(kSeenRays, kClvFar);
                std::ranges::nth_element(distances, distances.begin() + kSightRank);
                all.sight[2 * k + side] = distances[kSightRank];
                kept[2 * k + side] = embree.solids() ? seen.fronts > seen.backs : seen.fronts + seen.backs > 0;
            }
        }
    });
    SurfaceSamples samples;
    std::vector<std::pair<std::uint64_t, std::size_t>> order;
    for (std::size_t k = 0; k < 2 * count; ++k) {
        if (kept[k]) order.emplace_back(placeOf(all.receivers[k].position, all.receivers[k].normal, scene.bounds), k);
    }
    std::sort(order.begin(), order.end());
    for (const auto& [place, k] : order) {
        samples.receivers.push_back(all.receivers[k]);
        samples.albedo.push_back(all.albedo[k / 2]);
        samples.area.push_back(all.area[k / 2]);
        samples.sight.push_back(all.sight[k]);
    }
    return samples;
}

void sortAlongSurfaces(std::vector<ClvRsmTexel>& texels, const Bounds& bounds) {
    std::vector<std::pair<std::uint64_t, std::size_t>> order(texels.size());
    for (std::size_t k = 0; k < texels.size(); ++k) order[k] = {placeOf(texels[k].position, texels[k].normal, bounds), k};
    std::sort(order.begin(), order.end());
    std::vector<ClvRsmTexel> sorted(texels.size());
    for (std::size_t k = 0; k < texels.size(); ++k) sorted[k] = texels[order[k].second];
    texels = std::move(sorted);
}

}  // namespace clv
