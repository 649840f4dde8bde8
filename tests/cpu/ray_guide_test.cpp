// Guided rays bring the same light as unguided ones, and more of them meet something.
#include <cmath>

#include <gtest/gtest.h>

#include "clv/cpu/rays.h"
#include "support/z_test.h"

namespace clv::test {
namespace {

constexpr int kSide = 16;  // texels

// A floor that sends 1 W a texel into the half space above, under an open sky. Rays from its first quarter meet something where
// they lean towards +x far enough.
struct OpenFloor {
    static constexpr float kLean = 0.5f;  // cosine to the x axis
    std::vector<ClvRsmTexel> texels;

    OpenFloor() {
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x)
                texels.push_back({vec3((x + 0.5f) / kSide, 0.0f, (y + 0.5f) / kSide), 0.0f, vec3(0, 1, 0), 1u, vec3(1.0f), 0.0f});
        }
    }
    static void trace(std::span<ClvRay> rays) {
        for (ClvRay& ray : rays) ray.maxDistance = ray.origin.x < 0.25f && ray.direction.x > kLean ? 1.0f : kClvFar;
    }
    // W: cosine-distributed directions are uniform on the unit disk below them, and those that lean far enough a segment of it.
    static double fluxThatMeets() {
        const double segment = std::acos(kLean) - kLean * std::sqrt(1.0 - kLean * kLean);
        return 0.25 * kSide * kSide * segment / M_PI;
    }
    std::vector<ClvRay> tracedRays(const RayGuide* guide, std::size_t count, uint seed) const {
        TexelSampler sampler;
        sampler.build(texels, kSide, serialFor(), guide);
        std::vector<ClvRay> rays(count);
        makeRays(sampler, 0, seed, 0.0f, rays);
        trace(rays);
        return rays;
    }
    RayGuide learntGuide() const {
        RayGuide guide(vec3(0.0f), vec3(1.0f));
        guide.learn(tracedRays(nullptr, 16384, 99));
        guide.finish();
        return guide;
    }
};

double meanFluxThatMeets(std::span<const ClvRay> rays) {
    double sum = 0.0;
    for (const ClvRay& ray : rays) sum += ray.maxDistance < kClvFar ? double(ray.flux.x) : 0.0;
    return sum / double(rays.size());
}

double shareThatMeets(std::span<const ClvRay> rays) {
    return double(std::ranges::count_if(rays, [](const ClvRay& ray) { return ray.maxDistance < kClvFar; })) / double(rays.size());
}

TEST(RayGuide, bringsTheSameLightWithTheGuideAndWithout) {
    const OpenFloor floor;
    const RayGuide guide = floor.learntGuide();
    MeanOf guided, unguided, sent;
    for (uint seed = 0; seed < 200; ++seed) {
        const auto rays = floor.tracedRays(&guide, 1024, seed);
        guided.add(meanFluxThatMeets(rays));
        unguided.add(meanFluxThatMeets(floor.tracedRays(nullptr, 1024, seed)));
        double all = 0.0;
        for (const ClvRay& ray : rays) all += ray.flux.x;
        sent.add(all / double(rays.size()));
    }
    ZTest test;
    test.add("guided", guided, OpenFloor::fluxThatMeets());
    test.add("unguided", unguided, OpenFloor::fluxThatMeets());
    test.add("guided, whether it meets something or not", sent, kSide * kSide);
    EXPECT_TRUE(test.agrees());
}

TEST(RayGuide, sendsMoreRaysWhereEarlierOnesMetSomething) {
    const OpenFloor floor;
    const RayGuide guide = floor.learntGuide();
    const double share = OpenFloor::fluxThatMeets() / (kSide * kSide);
    EXPECT_TRUE(guide.worthwhile());
    EXPECT_NEAR(guide.share(), share, 0.2 * share);
    EXPECT_NEAR(shareThatMeets(floor.tracedRays(nullptr, 65536, 5)), share, 0.05 * share);
    EXPECT_GT(shareThatMeets(floor.tracedRays(&guide, 65536, 5)), 2.0 * share);
}

TEST(RayGuide, prefersPlacesAndDirectionsThatMetSomething) {
    const RayGuide guide = OpenFloor().learntGuide();
    const vec3 here(0.1f, 0.0f, 0.5f), there(0.9f, 0.0f, 0.5f);
    EXPECT_GT(guide.texelWeight(here), 1.5f * guide.texelWeight(there));
    const uint row[] = {guide.rowAt(here), guide.rowAt(here)};
    const float x[] = {0.8f, -0.8f}, y[] = {0.6f, 0.6f}, z[] = {0.0f, 0.0f};
    float weight[2];
    guide.directionWeights(2, row, x, y, z, weight);
    EXPECT_GT(weight[0], 1.5f * weight[1]);
}

// What shaders run, a ray at a time, is what the blocks of the CPU compute.
TEST(RayGuide, choosesRayByRayWhatItChoosesInBlocks) {
    const OpenFloor floor;
    const RayGuide guide = floor.learntGuide();
    constexpr uint kSeed = 5, kRays = 4096;
    const auto rays = floor.tracedRays(&guide, kRays, kSeed);
    TexelSampler sampler;
    sampler.build(floor.texels, kSide, serialFor(), &guide);
    std::size_t resampled = 0;
    for (uint i = 0; i < kRays; ++i) {
        const vec4 u = clvSobol4(i, kSeed);
        ClvRsmTexel texel;
        float probability;
        sampler.sample(1, &u.x, &u.y, &texel, &probability);
        const ClvGuidedDirection guided = clvGuideDirection(guide, guide.rowAt(texel.position), texel.normal, vec2(u.z, u.w), clvGuideChoice(i, kSeed));
        ASSERT_EQ(rays[i].origin, texel.position) << i;
        ASSERT_EQ(rays[i].direction, guided.direction) << i;
        ASSERT_EQ(rays[i].flux, texel.flux * (1.0f / (probability * guided.probability))) << i;
        resampled += guided.direction != clvCosineFromSquare(vec2(u.z, u.w), texel.normal);
    }
    EXPECT_GT(resampled, kRays / 4);
}

// Rays of a map whose texels are alike carry all of its flux each, unless the guide says otherwise.
TEST(RayGuide, boundsByHowMuchItRaisesTheFluxOfARay) {
    const OpenFloor floor;
    const RayGuide guide = floor.learntGuide();
    float largest = 0.0f;
    for (const ClvRay& ray : floor.tracedRays(&guide, 65536, 5)) largest = std::max(largest, ray.flux.x);
    EXPECT_GT(largest, 1.5f * kSide * kSide);
    EXPECT_LE(largest, guide.largestGain() * kSide * kSide);
    EXPECT_EQ(RayGuide(vec3(0.0f), vec3(1.0f)).largestGain(), 1.0f);
}

TEST(RayGuide, aClosedSceneIsNotGuided) {
    const OpenFloor floor;
    auto rays = floor.tracedRays(nullptr, 4096, 1);
    for (ClvRay& ray : rays) ray.maxDistance = 1.0f;
    RayGuide guide(vec3(0.0f), vec3(1.0f));
    guide.learn(rays);
    guide.finish();
    EXPECT_EQ(guide.share(), 1.0);
    EXPECT_FALSE(guide.worthwhile());
    TexelSampler sampler;
    sampler.build(floor.texels, kSide, serialFor(), &guide);
    EXPECT_EQ(sampler.guide(), nullptr);
}

TEST(RayGuide, whereNothingWasMetNothingIsPreferred) {
    const OpenFloor floor;
    auto rays = floor.tracedRays(nullptr, 4096, 1);
    for (ClvRay& ray : rays) ray.maxDistance = kClvFar;
    RayGuide guide(vec3(0.0f), vec3(1.0f));
    guide.learn(rays);
    guide.finish();
    EXPECT_EQ(guide.share(), 0.0);
    EXPECT_EQ(guide.texelWeight(vec3(0.1f)), guide.texelWeight(vec3(0.9f)));
}

}  // namespace
}  // namespace clv::test
