// The most that a ray can carry: what sums in fixed point must have room for.
#ifndef CLV_PLAN_LARGEST_FLUX_H
#define CLV_PLAN_LARGEST_FLUX_H
#include <algorithm>
#include <cmath>
#include <span>

#include "../stages/rays.h"
#include "../stages/rsm.h"

namespace clv {

// Texels are picked in proportion to their flux, and a ray stands for the light of them all: none of its channels, W, carries more than
// all texels do in all of theirs.
inline float largestRayFlux(std::span<const ClvRsmTexel> texels) {
    double sum = 0.0;
    for (const ClvRsmTexel& texel : texels) sum += clvTexelWeight(texel);
    return float(sum);
}

// The same of rays that are known.
inline float largestRayFlux(std::span<const ClvRay> rays) {
    float largest = 0.0f;
    for (const ClvRay& ray : rays) largest = std::max({largest, ray.flux.x, ray.flux.y, ray.flux.z});
    return largest;
}

// The same before the lights' maps are known: surfaces send on no more than they receive. [lo, hi]: the scene's bounds, m.
inline float largestRayFlux(std::span<const ClvLight> lights, const vec3& lo, const vec3& hi) {
    double sum = 0.0;
    for (const ClvLight& light : lights) {
        // The middle of a map is its brightest point.
        const vec3 flux = clvLightRay(light, vec2(0.5f), lo, hi).flux;
        sum += double(flux.x) + flux.y + flux.z;
    }
    return float(sum);
}

// The same with a guide, for sums over this many rays: it raises the flux of single rays by up to `gain` (RayGuide::largestGain), while
// their mean stays as it was. A ray's variance is below gain * flux^2, and the mean of many does not stray by ten standard deviations.
inline float guidedRayFlux(float unguided, float gain, double rays) { return unguided * std::min(gain, 1.0f + 10.0f * float(std::sqrt(gain / rays))); }

}  // namespace clv
#endif
