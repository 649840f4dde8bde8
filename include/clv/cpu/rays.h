// Rays on the CPU: the rays of a frame, drawn from the RSMs by one four-dimensional sequence that continues across frames.
#ifndef CLV_CPU_RAYS_H
#define CLV_CPU_RAYS_H
#include "../math/sobol.h"
#include "../stages/rays.h"
#include "texel_sampler.h"

namespace clv {

// Ray k of `out` is number firstIndex + k of the sequence; two dimensions pick the texel, two the direction. Each ray carries the
// flux of the whole light, as if it were the only one: the mean over rays is the estimate. `originOffset`, m, see clvRayFromTexel.
inline void makeRays(const TexelSampler& sampler, uint firstIndex, uint seed, float originOffset, std::span<ClvRay> out) {
    for (std::size_t k = 0; k < out.size(); ++k) {
        const vec4 u = clvSobol4(firstIndex + uint(k), seed);
        float probability = 0.0f;
        const ClvRsmTexel& texel = sampler.sample(u.x, u.y, probability);
        out[k] = probability > 0.0f ? clvRayFromTexel(texel, vec2(u.z, u.w), 1.0f / probability, originOffset) : clvDeadRay();
    }
}

}  // namespace clv
#endif
