// Rays on the CPU: the rays of a frame, drawn from the RSMs by one four-dimensional sequence that continues across frames.
#ifndef CLV_CPU_RAYS_H
#define CLV_CPU_RAYS_H
#include <utility>

#include "../math/sobol.h"
#include "../stages/rays.h"
#include "texel_sampler.h"

namespace clv {

// Ray k of `out` is number firstIndex + k of the sequence; two dimensions pick the texel, two the direction. Each ray carries the
// flux of the whole light, as if it were the only one: the mean over rays is the estimate. `originOffset`, m, see clvRayAlong.
inline void makeRays(const TexelSampler& sampler, uint firstIndex, uint seed, float originOffset, std::span<ClvRay> out) {
    // In blocks and stage by stage, on arrays: the compiler then makes vectors of it, and memory is fetched for many rays at once.
    constexpr int kBlock = TexelSampler::kBlock;
    float u[kClvSobolDimensions][kBlock], probability[kBlock], normal[3][kBlock], direction[3][kBlock];
    ClvRsmTexel texel[kBlock];
    for (std::size_t first = 0; first < out.size(); first += kBlock) {
        const int count = int(std::min<std::size_t>(kBlock, out.size() - first));
        const uint index = firstIndex + uint(first);
        auto draw = [&](auto dimension) {
            for (int k = 0; k < count; ++k) u[dimension][k] = clvSobolUnit(index + uint(k), dimension, seed);
        };
        [&]<uint... dimension>(std::integer_sequence<uint, dimension...>) {
            (draw(std::integral_constant<uint, dimension>()), ...);
        }(std::make_integer_sequence<uint, kClvSobolDimensions>());
        sampler.sample(count, u[0], u[1], texel, probability);
        for (int k = 0; k < count; ++k) {
            for (int axis = 0; axis < 3; ++axis) normal[axis][k] = texel[k].normal[axis];
        }
        for (int k = 0; k < count; ++k) {
            const vec3 d = clvCosineFromSquare(vec2(u[2][k], u[3][k]), vec3(normal[0][k], normal[1][k], normal[2][k]));
            direction[0][k] = d.x;
            direction[1][k] = d.y;
            direction[2][k] = d.z;
        }
        for (int k = 0; k < count; ++k) {
            const vec3 d(direction[0][k], direction[1][k], direction[2][k]);
            out[first + k] = probability[k] > 0.0f ? clvRayAlong(texel[k], d, 1.0f / probability[k], originOffset) : clvDeadRay();
        }
    }
}

}  // namespace clv
#endif
