#include "clv/cpu/rays.h"

#include <gtest/gtest.h>

#include <cstring>

#include "support/chi_square.h"

using namespace clv;

namespace {

// A curved, partly lit surface.
std::vector<ClvRsmTexel> someTexels(int width, int height) {
    std::vector<ClvRsmTexel> texels(std::size_t(width) * height);
    for (int i = 0; i < int(texels.size()); ++i) {
        ClvRsmTexel& t = texels[i];
        t = {};
        const float x = (float(i % width) + 0.5f) / float(width) - 0.5f, y = (float(i / width) + 0.5f) / float(height) - 0.5f;
        t.valid = x * x + y * y < 0.25f;
        t.position = vec3(x, 0.2f * x * y, y);
        t.normal = normalize(vec3(x, 1.0f, y));
        t.flux = vec3(1.0f + float(i % 7), 1.0f, 0.5f) * 1e-3f;
        t.dynamicity = 0.5f;
    }
    return texels;
}

bool sameBits(const ClvRay& a, const ClvRay& b) { return std::memcmp(&a, &b, sizeof(ClvRay)) == 0; }

TEST(MakeRays, raysDoNotDependOnHowTheRangeIsCut) {
    const auto texels = someTexels(37, 29);
    TexelSampler sampler;
    sampler.build(texels, 37, serialFor());
    const std::size_t count = 1500;
    const uint firstIndex = 12345u;
    std::vector<ClvRay> whole(count), pieces(count);
    makeRays(sampler, firstIndex, 7u, 1e-3f, whole);
    for (std::size_t length : {1, 3, 16, 255, 256, 257, 700}) {
        std::fill(pieces.begin(), pieces.end(), clvDeadRay());
        for (std::size_t first = 0; first < count; first += length) {
            const std::size_t n = std::min(length, count - first);
            makeRays(sampler, firstIndex + uint(first), 7u, 1e-3f, std::span(pieces).subspan(first, n));
        }
        for (std::size_t k = 0; k < count; ++k) ASSERT_TRUE(sameBits(whole[k], pieces[k])) << "ray " << k << ", pieces of " << length;
    }
}

TEST(MakeRays, eachRayIsTheSharedFunctionOfItsPointOfTheSequence) {
    const auto texels = someTexels(64, 32);
    TexelSampler sampler;
    sampler.build(texels, 64, serialFor());
    std::vector<ClvRay> rays(1000);
    makeRays(sampler, 99u, 3u, 1e-3f, rays);
    for (uint k = 0; k < rays.size(); ++k) {
        const vec4 u = clvSobol4(99u + k, 3u);
        ClvRsmTexel texel;
        float probability = 0.0f;
        sampler.sample(1, &u.x, &u.y, &texel, &probability);
        ASSERT_TRUE(sameBits(rays[k], clvRayFromTexel(texel, vec2(u.z, u.w), 1.0f / probability, 1e-3f))) << k;
    }
}

TEST(MakeRays, theMeanRayCarriesTheWholeFluxAndEachRayTheSamePower) {
    const auto texels = someTexels(64, 64);
    TexelSampler sampler;
    sampler.build(texels, 64, serialFor());
    vec3 expected(0.0f);
    for (const ClvRsmTexel& t : texels) {
        if (t.valid != 0u) expected += t.flux;
    }
    std::vector<ClvRay> rays(1 << 16);
    makeRays(sampler, 0u, 1u, 0.0f, rays);
    double sum[3] = {};
    for (const ClvRay& ray : rays) {
        for (int c = 0; c < 3; ++c) sum[c] += ray.flux[c];
        ASSERT_NEAR((ray.flux.x + ray.flux.y + ray.flux.z) / sampler.totalFlux(), 1.0, 1e-3);
        ASSERT_EQ(ray.dynamicity, 0.5f);
        ASSERT_EQ(ray.maxDistance, kClvFar);
    }
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / double(rays.size()) / expected[c], 1.0, 2e-3) << c;
}

TEST(MakeRays, directionsAreCosineDistributed) {
    std::vector<ClvRsmTexel> texels(4);
    const vec3 normal = normalize(vec3(0.3f, -0.8f, 0.5f));
    for (ClvRsmTexel& t : texels) t = {}, t.valid = 1u, t.normal = normal, t.flux = vec3(1.0f);
    TexelSampler sampler;
    sampler.build(texels, 2, serialFor());
    // The squared cosine of a cosine-weighted direction is uniform. A bin of the sequence's 2^16 points is off by a few points at most.
    std::vector<ClvRay> rays(1 << 16);
    makeRays(sampler, 0u, 2u, 0.0f, rays);
    int counts[32] = {};
    for (const ClvRay& ray : rays) {
        const float cosine = dot(ray.direction, normal);
        ASSERT_GE(cosine, 0.0f);
        ASSERT_NEAR(length(ray.direction), 1.0f, 3e-7f);
        counts[std::min(31, int(32.0f * cosine * cosine))]++;
    }
    for (int bin = 0; bin < 32; ++bin) EXPECT_NEAR(counts[bin], int(rays.size()) / 32, 100) << bin;
}

TEST(MakeRays, withoutLightAllRaysAreDead) {
    std::vector<ClvRsmTexel> texels(16);
    for (ClvRsmTexel& t : texels) t = {}, t.normal = vec3(0.0f, 1.0f, 0.0f);
    TexelSampler sampler;
    sampler.build(texels, 4, serialFor());
    std::vector<ClvRay> rays(300);
    makeRays(sampler, 0u, 1u, 0.0f, rays);
    for (const ClvRay& ray : rays) ASSERT_TRUE(sameBits(ray, clvDeadRay()));
    // No light at all has no map.
    sampler.build({}, 4, serialFor());
    ASSERT_TRUE(sampler.empty());
    std::fill(rays.begin(), rays.end(), ClvRay{});
    makeRays(sampler, 0u, 1u, 0.0f, rays);
    for (const ClvRay& ray : rays) ASSERT_TRUE(sameBits(ray, clvDeadRay()));
}

}  // namespace
