// The rays stage: from a texel of a reflective shadow map to a ray that leaves it.
#ifndef CLV_STAGES_RAYS_H
#define CLV_STAGES_RAYS_H
#include "../data/ray.h"
#include "../data/rsm_texel.h"
#include "../math/finite.h"
#include "../math/sampling.h"
CLV_NAMESPACE_BEGIN

// A texel's chance to be picked is in proportion to this, W: its flux over all channels; 0 for one that sends no rays, or whose
// flux is not a number that sums can hold.
CLV_FN float clvTexelWeight(ClvRsmTexel texel) {
    float sum = texel.flux.x + texel.flux.y + texel.flux.z;
    return texel.valid != 0u && sum > 0.0f && sum < 1e30f ? sum : 0.0f;
}

// A ray that carries nothing and goes nowhere: later stages skip it by maxDistance = 0.
CLV_FN ClvRay clvDeadRay() {
    ClvRay ray;
    ray.origin = vec3(0.0f, 0.0f, 0.0f);
    ray.maxDistance = 0.0f;
    ray.direction = vec3(0.0f, 1.0f, 0.0f);
    ray.dynamicity = 0.0f;
    ray.flux = vec3(0.0f, 0.0f, 0.0f);
    ray.pad0 = 0.0f;
    return ray;
}

// A ray from the texel's surface along `direction`. invPdfScale: how many texels this ray stands for: 1 / (its texel's chance to
// be picked * the number of rays). originOffset: m along the normal, so that the ray does not meet its own surface.
// A texel without a surface, or whose flux is not finite, gives a dead ray.
CLV_FN ClvRay clvRayAlong(ClvRsmTexel texel, vec3 direction, float invPdfScale, float originOffset) {
    ClvRay ray = clvDeadRay();
    if (texel.valid == 0u || !clvIsFinite(texel.flux)) return ray;
    ray.origin = texel.position + texel.normal * originOffset;
    ray.maxDistance = kClvFar;
    ray.direction = direction;
    ray.dynamicity = texel.dynamicity;
    ray.flux = texel.flux * invPdfScale;
    return ray;
}

// The same into the texel's hemisphere, cosine-weighted: a Lambertian surface sends the same flux along each. directionSample:
// in [0, 1)^2.
CLV_FN ClvRay clvRayFromTexel(ClvRsmTexel texel, vec2 directionSample, float invPdfScale, float originOffset) {
    return clvRayAlong(texel, clvCosineFromSquare(directionSample, texel.normal), invPdfScale, originOffset);
}

// Russian roulette: 0 kills the ray, anything else multiplies its flux. Rays whose largest channel is at or above
// `threshold` (W) live on unchanged; a weaker one survives with probability largest / threshold and then carries
// `threshold` there, so that the expected flux stays the same. u: in [0, 1). A ray without flux, or whose flux is not finite, dies.
CLV_FN float clvRoulette(vec3 flux, float threshold, float u) {
    float largest = max(flux.x, max(flux.y, flux.z));
    if (!(largest > 0.0f) || !clvIsFinite(flux)) return 0.0f;
    if (largest >= threshold) return 1.0f;
    // u has 24 bits: no smaller chance can be drawn, and 1 / chance stays finite.
    float chance = max(largest / threshold, 1.0f / 16777216.0f);
    return u < chance ? 1.0f / chance : 0.0f;
}

// Does the segment stay outside the box [lo, hi] (m), widened by `margin` (m) on all sides? Never says so of a segment
// that crosses the box; a margin of a millionth of the largest coordinate covers the rounding.
CLV_FN bool clvRayMissesRegion(vec3 origin, vec3 direction, float maxDistance, vec3 lo, vec3 hi, float margin) {
    float enter = 0.0f;
    float leave = maxDistance;
    for (int axis = 0; axis < 3; ++axis) {
        float toLo = lo[axis] - margin - origin[axis];
        float toHi = hi[axis] + margin - origin[axis];
        float d = direction[axis];
        if (d == 0.0f) {
            if (toLo > 0.0f || toHi < 0.0f) return true;
        } else {
            enter = max(enter, min(toLo / d, toHi / d));
            leave = min(leave, max(toLo / d, toHi / d));
        }
    }
    return enter > leave;
}

CLV_NAMESPACE_END
#endif
