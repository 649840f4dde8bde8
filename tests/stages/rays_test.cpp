#include "clv/stages/rays.h"

#include <gtest/gtest.h>

#include <limits>

#include "clv/math/sobol.h"
#include "clv/stages/trace.h"
#include "support/chi_square.h"

using namespace clv;

namespace rays_test {

ClvRsmTexel texelAt(vec3 position, vec3 normal) {
    ClvRsmTexel texel{};
    texel.position = position;
    texel.normal = normal;
    texel.valid = 1u;
    texel.flux = vec3(1.0f, 2.0f, 3.0f);
    texel.dynamicity = 0.25f;
    return texel;
}

bool isDead(const ClvRay& ray) {
    return ray.maxDistance == 0.0f && ray.flux == vec3(0.0f) && length(ray.direction) == 1.0f;
}

TEST(Rays, aRayLeavesItsTexelOnTheLitSideWithTheTexelsLight) {
    vec3 normal = normalize(vec3(1.0f, -2.0f, 0.5f));
    ClvRsmTexel texel = texelAt(vec3(4.0f, 5.0f, 6.0f), normal);
    for (uint i = 0; i < 1000; ++i) {
        vec4 u = clvSobol4(i, 1u);
        ClvRay ray = clvRayFromTexel(texel, vec2(u.z, u.w), 0.5f, 0.01f);
        ASSERT_GE(dot(ray.direction, normal), 0.0f);
        ASSERT_EQ(ray.origin, texel.position + 0.01f * normal);
        ASSERT_EQ(ray.flux, vec3(0.5f, 1.0f, 1.5f));
        ASSERT_EQ(ray.maxDistance, kClvFar);
        ASSERT_EQ(ray.dynamicity, 0.25f);
    }
}

TEST(Rays, aTexelsRaysCarryItsFluxAndItsIrradianceFallsAsLambertsLaw) {
    // Rays of a texel of 1 W at height h over a plane: the irradiance below is that of a Lambertian source, cos^4 / (pi h^2).
    const float height = 2.0f, halfSize = 0.25f;
    const int count = 1 << 20;
    ClvRsmTexel texel = texelAt(vec3(0.0f, height, 0.0f), vec3(0.0f, -1.0f, 0.0f));
    for (float offset : {0.0f, 2.0f}) {
        double flux = 0.0;
        for (int i = 0; i < count; ++i) {
            vec4 u = clvSobol4(uint(i), 1u);
            ClvRay ray = clvRayFromTexel(texel, vec2(u.x, u.y), 1.0f / count, 0.0f);
            vec3 hit = ray.direction * (height / -ray.direction.y);
            if (std::abs(hit.x - offset) < halfSize && std::abs(hit.z) < halfSize) flux += ray.flux.x;
        }
        // The patch's mean by the midpoint rule.
        double expected = 0.0;
        const int n = 64;
        for (int i = 0; i < n * n; ++i) {
            double x = offset + halfSize * (2.0 * (i % n + 0.5) / n - 1.0), z = halfSize * (2.0 * (i / n + 0.5) / n - 1.0);
            double squared = x * x + z * z + double(height) * height;
            expected += double(height) * height / (double(kClvPi) * squared * squared) * 4.0 * halfSize * halfSize / (n * n);
        }
        EXPECT_NEAR(flux / expected, 1.0, 3e-3) << offset;
    }
}

TEST(Rays, aTexelWithoutASurfaceOrWithoutFiniteFluxGivesADeadRay) {
    ClvRsmTexel texel = texelAt(vec3(1.0f), vec3(0.0f, 1.0f, 0.0f));
    EXPECT_FALSE(isDead(clvRayFromTexel(texel, vec2(0.3f, 0.6f), 1.0f, 0.0f)));
    texel.flux.y = std::numeric_limits<float>::infinity();
    EXPECT_TRUE(isDead(clvRayFromTexel(texel, vec2(0.3f, 0.6f), 1.0f, 0.0f)));
    EXPECT_TRUE(isDead(clvRayFromTexel(ClvRsmTexel{}, vec2(0.3f, 0.6f), 1.0f, 0.0f)));
}

TEST(Roulette, keepsTheExpectedFluxAtEveryStrength) {
    const float threshold = 3.0f;
    for (float strength : {0.001f, 0.03f, 0.4f, 0.99f, 1.0f, 5.0f}) {
        vec3 flux = vec3(0.2f, 1.0f, 0.7f) * (threshold * strength);
        const int rays = 1 << 16;
        double sum = 0.0;
        // A stratified u: survivors are counted to within one.
        for (int i = 0; i < rays; ++i) sum += clvRoulette(flux, threshold, (i + 0.5f) / rays);
        EXPECT_NEAR(sum / rays, 1.0, 1.0 / (rays * std::min(strength, 1.0f)) + 1e-5) << strength;
    }
}

TEST(Roulette, fluxThatIsNotFiniteDies) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();
    for (const float bad : {kNan, kInfinity, -kInfinity})
        for (const vec3& flux : {vec3(bad, 1.0f, 0.0f), vec3(1.0f, bad, 0.0f), vec3(0.0f, 1.0f, bad)}) EXPECT_EQ(clvRoulette(flux, 0.5f, 0.3f), 0.0f) << flux.x << " " << flux.y << " " << flux.z;
}

TEST(Roulette, survivorsCarryTheThreshold) {
    vec3 flux(0.1f, 0.4f, 0.2f);
    float weight = clvRoulette(flux, 2.0f, 0.0f);
    EXPECT_FLOAT_EQ(weight * flux.y, 2.0f);
    EXPECT_EQ(clvRoulette(flux, 2.0f, 0.99f), 0.0f);
    EXPECT_EQ(clvRoulette(flux, 0.4f, 0.999f), 1.0f);
    EXPECT_EQ(clvRoulette(flux, 0.0f, 0.999f), 1.0f);
}

TEST(Roulette, extremesStayFinite) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(clvRoulette(vec3(0.0f), 0.0f, 0.0f), 0.0f);
    EXPECT_EQ(clvRoulette(vec3(nan), 1.0f, 0.0f), 0.0f);
    // A chance below what 24 bits can draw is raised to one draw of 2^24, and the weight to its inverse.
    EXPECT_EQ(clvRoulette(vec3(1e-44f), 1e3f, 0.0f), 16777216.0f);
    EXPECT_EQ(clvRoulette(vec3(1e-44f), 1e3f, 1.0f / 16777216.0f), 0.0f);
}

const vec3 kLo(-1.0f, -2.0f, -3.0f), kHi(4.0f, 5.0f, 6.0f);
const float kMargin = 1e-5f;

TEST(Culling, keepsEverySegmentThatCrossesTheRegion) {
    for (uint i = 0; i < 300000; ++i) {
        // A point inside the box, and a segment through it from anywhere.
        vec3 inside = kLo + (kHi - kLo) * vec3(test::randomUnit(1u, i), test::randomUnit(2u, i), test::randomUnit(3u, i));
        float back = 50.0f * test::randomUnit(4u, i);
        vec3 direction = test::randomDirection(5u, i), origin = inside - back * direction;
        ASSERT_FALSE(clvRayMissesRegion(origin, direction, back * 1.0001f + 1e-5f, kLo, kHi, kMargin)) << i;
        ASSERT_FALSE(clvRayMissesRegion(origin, direction, kClvFar, kLo, kHi, kMargin)) << i;
    }
}

TEST(Culling, keepsRaysThatOnlyTouchTheRegion) {
    EXPECT_FALSE(clvRayMissesRegion(vec3(-10.0f, 5.0f, 0.0f), vec3(1.0f, 0.0f, 0.0f), kClvFar, kLo, kHi, kMargin));
    EXPECT_FALSE(clvRayMissesRegion(vec3(-10.0f, 5.0f, 6.0f), vec3(1.0f, 0.0f, 0.0f), kClvFar, kLo, kHi, kMargin));
    EXPECT_FALSE(clvRayMissesRegion(vec3(0.0f), vec3(0.0f, -1.0f, 0.0f), 0.0f, kLo, kHi, kMargin));
}

TEST(Culling, dropsSegmentsThatEndBeforeStartBehindOrPassBy) {
    const vec3 x(1.0f, 0.0f, 0.0f);
    EXPECT_TRUE(clvRayMissesRegion(vec3(-10.0f, 0.0f, 0.0f), x, 8.9f, kLo, kHi, kMargin));
    EXPECT_FALSE(clvRayMissesRegion(vec3(-10.0f, 0.0f, 0.0f), x, 9.1f, kLo, kHi, kMargin));
    EXPECT_TRUE(clvRayMissesRegion(vec3(4.1f, 0.0f, 0.0f), x, kClvFar, kLo, kHi, kMargin));
    EXPECT_TRUE(clvRayMissesRegion(vec3(-10.0f, 5.1f, 0.0f), x, kClvFar, kLo, kHi, kMargin));
    EXPECT_TRUE(clvRayMissesRegion(vec3(-10.0f, 5.1f, 0.0f), normalize(vec3(1.0f, 1e-3f, 0.0f)), kClvFar, kLo, kHi, kMargin));
}

TEST(Culling, theMarginWidensTheRegion) {
    const vec3 x(1.0f, 0.0f, 0.0f);
    EXPECT_TRUE(clvRayMissesRegion(vec3(-10.0f, 5.5f, 0.0f), x, kClvFar, kLo, kHi, 0.4f));
    EXPECT_FALSE(clvRayMissesRegion(vec3(-10.0f, 5.5f, 0.0f), x, kClvFar, kLo, kHi, 0.6f));
    EXPECT_FALSE(clvRayMissesRegion(vec3(-10.0f, 0.0f, 0.0f), x, 8.9f, kLo, kHi, 0.2f));
}

TEST(Culling, dropsWhatMissesAlmostAlways) {
    // Sampling the segment densely is the judge; misses by less than the samples' spacing may go either way.
    int missed = 0, dropped = 0;
    for (uint i = 0; i < 20000; ++i) {
        vec3 origin = 30.0f * test::randomDirection(6u, i), direction = test::randomDirection(7u, i);
        float length = 60.0f * test::randomUnit(8u, i), nearest = 1e9f;
        for (int s = 0; s <= 600; ++s) {
            vec3 p = origin + direction * (length * float(s) / 600.0f);
            vec3 out = max(max(kLo - p, p - kHi), vec3(0.0f));
            nearest = std::min(nearest, glm::length(out));
        }
        if (nearest < 0.1f) continue;
        ++missed;
        dropped += clvRayMissesRegion(origin, direction, length, kLo, kHi, kMargin);
    }
    EXPECT_GT(missed, 15000);
    EXPECT_EQ(dropped, missed);
}

TEST(Trace, aHitCutsTheRayAndOnlyTheRay) {
    ClvRay ray = clvRayFromTexel(texelAt(vec3(1.0f), vec3(0.0f, 1.0f, 0.0f)), vec2(0.3f, 0.6f), 1.0f, 0.0f);
    ClvHit hit = clvNoHit();
    EXPECT_EQ(clvCutRay(ray, hit).maxDistance, kClvFar);
    hit.distance = 2.5f;
    ClvRay cut = clvCutRay(ray, hit);
    EXPECT_EQ(cut.maxDistance, 2.5f);
    EXPECT_EQ(cut.origin, ray.origin);
    EXPECT_EQ(cut.direction, ray.direction);
    EXPECT_EQ(cut.flux, ray.flux);
    hit.distance = 4.0f;
    EXPECT_EQ(clvCutRay(cut, hit).maxDistance, 2.5f);
}

TEST(Trace, deadRaysStayDeadAndNanChangesNothing) {
    ClvHit hit = clvNoHit();
    hit.distance = 1.0f;
    EXPECT_EQ(clvCutRay(clvDeadRay(), hit).maxDistance, 0.0f);
    ClvRay ray = clvDeadRay();
    ray.maxDistance = 3.0f;
    hit.distance = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(clvCutRay(ray, hit).maxDistance, 3.0f);
    hit.distance = -1.0f;
    EXPECT_EQ(clvCutRay(ray, hit).maxDistance, 0.0f);
}

TEST(Trace, theFacingNormalOpposesTheRay) {
    vec3 n(0.0f, 1.0f, 0.0f);
    EXPECT_EQ(clvFacingNormal(n, vec3(0.6f, 0.8f, 0.0f)), -n);
    EXPECT_EQ(clvFacingNormal(n, vec3(0.6f, -0.8f, 0.0f)), n);
}

}  // namespace rays_test
