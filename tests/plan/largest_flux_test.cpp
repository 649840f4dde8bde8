// No ray carries more than the bounds say, whatever its light and map.
#include <gtest/gtest.h>

#include "clv/cpu/rays.h"
#include "clv/plan/largest_flux.h"

using namespace clv;

namespace {

constexpr int kSide = 32;

// The maps of lights in a room whose walls reflect everything.
std::vector<ClvRsmTexel> whiteMaps(std::span<const ClvLight> lights, const vec3& lo, const vec3& hi) {
    std::vector<ClvRsmTexel> texels;
    for (const ClvLight& light : lights) {
        for (int i = 0; i < kSide * kSide; ++i) {
            const ClvRay ray = clvLightRay(light, (vec2(i % kSide, i / kSide) + 0.5f) / float(kSide), lo, hi);
            const ClvHit hit{-ray.direction, 1.0f, vec3(1.0f), 0u};
            texels.push_back(clvRsmTexelFromHit(ray, hit, 1.0f / float(kSide * kSide)));
        }
    }
    return texels;
}

float largestChannel(std::span<const ClvRsmTexel> texels) {
    TexelSampler sampler;
    sampler.build(texels, kSide, serialFor());
    std::vector<ClvRay> rays(16384);
    makeRays(sampler, 0, 7, 0.0f, rays);
    float largest = 0.0f;
    for (const ClvRay& ray : rays) largest = std::max(largest, std::max(ray.flux.x, std::max(ray.flux.y, ray.flux.z)));
    return largest;
}

ClvLight lightOf(uint type, const vec3& intensity) {
    ClvLight light{};
    light.type = type, light.intensity = intensity, light.direction = vec3(0.6f, -0.8f, 0.0f);
    light.innerConeAngle = 0.2f, light.outerConeAngle = 0.7f;
    return light;
}

TEST(LargestFlux, boundsTheRaysOfEveryKindOfLight) {
    const vec3 lo(-1.0f, 0.0f, -2.0f), hi(3.0f, 2.5f, 2.0f);
    for (const uint type : {kClvLightPoint, kClvLightSpot, kClvLightDirectional}) {
        const ClvLight lights[] = {lightOf(type, vec3(1.0f, 5.0f, 0.0f)), lightOf(type, vec3(0.0f, 2.0f, 0.0f))};
        const auto texels = whiteMaps(lights, lo, hi);
        const float known = largestRayFlux(texels), foretold = largestRayFlux(lights, lo, hi);
        // The sampler's probabilities are differences of rounded sums.
        EXPECT_LE(largestChannel(texels), known * 1.001f) << type;
        EXPECT_GT(largestChannel(texels), 0.5f * known) << type;
        EXPECT_LE(known, foretold * 1.00001f) << type;
        // A cone's light falls off towards its rim.
        EXPECT_GT(known, (type == kClvLightSpot ? 0.3f : 0.9999f) * foretold) << type;
    }
}

TEST(LargestFlux, ofGuidedRaysIsTheLargestOfAFewAndTheMeanOfMany) {
    EXPECT_EQ(guidedRayFlux(3.0f, 1.0f, 1e6), 3.0f);
    EXPECT_EQ(guidedRayFlux(3.0f, 20.0f, 1.0), 60.0f);
    // Rays that carry 20 times the flux with a chance of 1/20, else nothing: no such mean varies more.
    const double rays = 4096.0, deviation = std::sqrt(19.0 / rays);
    EXPECT_GE(guidedRayFlux(1.0f, 20.0f, rays), 1.0 + 10.0 * deviation);
    EXPECT_LT(guidedRayFlux(1.0f, 20.0f, rays), 1.0 + 11.0 * deviation);
}

TEST(LargestFlux, leavesOutTexelsThatSendNothing) {
    std::vector<ClvRsmTexel> texels(kSide * kSide, {vec3(0.0f), 0.0f, vec3(0, 1, 0), 1u, vec3(1.0f, 0.0f, 2.0f), 0.0f});
    texels[3].valid = 0u, texels[4].flux = vec3(std::numeric_limits<float>::infinity());
    EXPECT_FLOAT_EQ(largestRayFlux(texels), 3.0f * (kSide * kSide - 2));
}

}  // namespace
