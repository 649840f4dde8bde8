#include "bindings/embree/surface_samples.h"

#include <algorithm>
#include <cmath>

#include "bindings/embree/seen_faces.h"
#include "clv/math/sobol.h"

namespace clv {

SurfaceSamples sampleSurfaces(const EmbreeScene& embree, std::size_t count, std::uint32_t seed, const ParallelFor& parallelFor) {
    constexpr std::size_t kPiece = 512;  // points
    const Scene& scene = embree.scene();
    std::vector<double> ends(scene.triangles.size());  // sums of areas, m^2
    double total = 0.0;
    for (std::size_t t = 0; t < ends.size(); ++t) ends[t] = total += 0.5 * double(glm::length(windingNormal(scene, std::uint32_t(t))));
    std::vector<ClvReceiver> all(2 * count);
    std::vector<std::uint8_t> kept(2 * count);
    parallelFor((count + kPiece - 1) / kPiece, [&](std::size_t piece) {
        for (std::size_t k = piece * kPiece; k < std::min(count, (piece + 1) * kPiece); ++k) {
            const vec4 u = clvSobol4(uint(k), seed);
            const double at = (double(k) + u.x) / double(count) * total;
            const std::size_t t = std::min<std::size_t>(std::lower_bound(ends.begin(), ends.end(), at) - ends.begin(), ends.size() - 1);
            const glm::uvec3& c = scene.triangles[t];
            // Uniform in a triangle: Turk 1990.
            const float root = std::sqrt(u.y), v1 = root * (1.0f - u.z), v2 = root * u.z;
            const vec3 a = scene.positions[c.x], b = scene.positions[c.y], d = scene.positions[c.z];
            const vec3 normal = glm::normalize(windingNormal(scene, std::uint32_t(t)));
            for (std::size_t i = 2 * k; i < 2 * k + 2; ++i) {
                all[i] = {a + v1 * (b - a) + v2 * (d - a), 0.0f, i % 2 == 0 ? normal : -normal, 0.0f};
                const SeenFaces seen = seenFaces(embree, all[i], clvHashCombine(seed, uint(i)));
                kept[i] = embree.solids() ? seen.fronts > seen.backs : seen.fronts + seen.backs > 0;
            }
        }
    });
    SurfaceSamples samples;
    samples.area = float(total / double(count));
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (kept[i]) samples.receivers.push_back(all[i]);
    }
    return samples;
}

}  // namespace clv
