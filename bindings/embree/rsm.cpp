#include "bindings/embree/rsm.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "clv/stages/rsm.h"

namespace clv {
namespace {

// Texels traced at a time: a few packets, whose rays and hits stay in the nearest cache.
constexpr std::size_t kChunk = 64;

}  // namespace

void renderRsm(const EmbreeScene& scene, const ClvLight& light, int resolution, std::uint32_t pass, std::uint32_t seed,
               const ParallelFor& parallelFor, std::span<ClvRsmTexel> texels) {
    assert(resolution > 0);
    const auto width = static_cast<std::size_t>(resolution);
    assert(texels.size() == width * width);
    const Bounds& bounds = scene.scene().bounds;
    const float texelShare = 1.0f / (static_cast<float>(resolution) * static_cast<float>(resolution));

    parallelFor(width, [&](std::size_t row) {
        std::array<ClvRay, kChunk> rays;
        std::array<ClvHit, kChunk> hits;
        for (std::size_t first = 0; first < width; first += kChunk) {
            const std::size_t count = std::min(kChunk, width - first);
            for (std::size_t i = 0; i < count; ++i) {
                const vec2 u = clvRsmSamplePoint(uvec2(first + i, row), static_cast<uint>(resolution), pass, seed);
                rays[i] = clvLightRay(light, u, bounds.lo, bounds.hi);
            }
            scene.trace(std::span(rays).first(count), std::span(hits).first(count));
            for (std::size_t i = 0; i < count; ++i) {
                texels[row * width + first + i] = clvRsmTexelFromHit(rays[i], hits[i], texelShare);
            }
        }
    });
}

}  // namespace clv
