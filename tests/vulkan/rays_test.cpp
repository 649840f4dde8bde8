// The rays pass draws the rays that the shared headers draw on the host.
#include <gtest/gtest.h>

#include "bindings/scene/builtin_scenes.h"
#include "bindings/vulkan/vulkan_frame.h"
#include "clv/math/sobol.h"
#include "clv/stages/pick_texel.h"
#include "clv/stages/rays.h"
#include "vulkan/rays_frame.h"
#include "vulkan/traced_scene.h"

using namespace clv;
using namespace clv::test;

namespace rays_test {

struct Sums {
    const std::vector<float>& sums;
    float clvReadTexelSum(uint i) const { return sums[i]; }
};

TEST(VulkanRays, areThoseOfTheHost) {
    const RaysFrame scene;
    const std::uint32_t kRays = RaysFrame::kRays, kSide = RaysFrame::kSide;
    VulkanDevice device({.device = "", .validate = true});
    for (const ShaderLanguage language : {ShaderLanguage::glsl, ShaderLanguage::hlsl}) {
        VulkanFrame run(device, scene.frame, language);
        scene.uploadTo(run);
        run.run("light");
        const std::vector<ClvRay> rays = RaysFrame::raysOf(run);
        for (std::uint32_t i = 0; i < kRays; ++i) {
            const std::uint32_t perHalf = kRays / 2;
            const vec4 u = clvSobol4(64 + i / perHalf * kRays + clvNeighbourIndex(i % perHalf, perHalf), 7);  // halves that lie apart
            const ClvTexelPick pick = clvPickTexel(Sums{scene.sums}, kSide, kSide, vec2(u.x, u.y));
            const ClvRay expected = clvRayFromTexel(scene.texels[pick.texel], vec2(u.z, u.w), 1.0f / pick.probability, 1e-3f);
            ASSERT_EQ(rays[i].origin, expected.origin) << i;
            ASSERT_EQ(rays[i].flux, expected.flux) << i;
            ASSERT_NEAR(length(rays[i].direction - expected.direction), 0.0f, 1e-6f) << i;
        }
    }
    EXPECT_EQ(device.messages(), std::vector<std::string>());
}

TEST(VulkanRays, areThoseOfTheHostWhereAGuidePrefersSome) {
    constexpr std::uint32_t kSide = 32, kRays = 8192;
    TracedScene traced(makeBuiltinScene("atrium"), kSide, kRays, false);
    const auto unguided = runInBothLanguages(traced).rays;
    RayGuide guide(traced.scene.bounds.lo, traced.scene.bounds.hi);
    guide.learn(unguided);
    guide.finish();
    ASSERT_TRUE(guide.worthwhile());
    traced.guideBy(guide);
    const TracedScene::Results results = runInBothLanguages(traced);
    const std::uint32_t rows = traced.constants.texelRows, perHalf = kRays / 2;
    for (std::uint32_t row = 0; row < rows; ++row) {
        double sum = 0.0, all = 0.0;
        const auto weightOf = [&](std::uint32_t i) {
            const ClvRsmTexel& texel = results.texels[row * kSide + i];
            return double(clvTexelWeight(texel) * guide.texelWeight(texel.position));
        };
        for (std::uint32_t i = 0; i < kSide; ++i) all += weightOf(i);
        for (std::uint32_t i = 0; all > 0.0 && i < kSide; ++i) {
            sum += weightOf(i);
            ASSERT_NEAR(results.sums[row * (kSide + 1) + i + 1], sum / all, 1e-6) << row;
        }
    }
    std::size_t meet = 0, metUnguided = 0;
    for (std::uint32_t i = 0; i < kRays; ++i) {
        const std::uint32_t index = i / perHalf * perHalf + clvNeighbourIndex(i % perHalf, perHalf);
        const vec4 u = clvSobol4(index, traced.constants.seed);
        const ClvTexelPick pick = clvPickTexel(Sums{results.sums}, kSide, rows, vec2(u.x, u.y));
        const ClvRsmTexel& texel = results.texels[pick.texel];
        const ClvGuidedDirection guided = clvGuideDirection(guide, guide.rowAt(texel.position), texel.normal, vec2(u.z, u.w), clvGuideChoice(index, traced.constants.seed));
        const ClvRay expected = clvRayAlong(texel, guided.direction, 1.0f / (pick.probability * guided.probability), traced.constants.originOffset);
        ASSERT_EQ(results.rays[i].origin, expected.origin) << i;
        ASSERT_EQ(results.rays[i].flux, expected.flux) << i;
        ASSERT_NEAR(length(results.rays[i].direction - expected.direction), 0.0f, 1e-6f) << i;
        meet += results.rays[i].maxDistance < kClvFar, metUnguided += unguided[i].maxDistance < kClvFar;
    }
    EXPECT_GT(meet, metUnguided + metUnguided / 4);
}

// Lit surfaces that the host knows, in place of the maps of lights: the same texels give the same rays.
TEST(VulkanRays, leaveEmittersAsTheyLeaveMaps) {
    TracedScene traced(makeBuiltinScene("cornell"), 32, 8192, true);
    const TracedScene::Results expected = runInBothLanguages(traced);
    traced.settings.emitters = expected.texels.size(), traced.settings.lights = 0;
    const TracedScene::Results results = runInBothLanguages(traced, expected.texels);
    EXPECT_TRUE(sameBits(results.rays, expected.rays));
    EXPECT_TRUE(sameBits(results.hits, expected.hits));
}

// Work groups lie in rows, and this many rays need a second row.
TEST(VulkanRays, mayBeMoreThanARowOfWorkGroups) {
    constexpr std::uint32_t kRays = CLV_GROUP_ROW * CLV_GROUP_SIZE + 128;
    RaysFrame scene;
    scene.constants.rayCount = kRays;
    scene.frame.buffers[3].bytes = kRays * sizeof(ClvRay);
    scene.frame.steps[0].passes[0].groups = groupsFor(kRays);
    ASSERT_EQ(scene.frame.steps[0].passes[0].groups.y, 2u);
    VulkanDevice device({.device = "", .validate = true});
    VulkanFrame run(device, scene.frame);
    scene.uploadTo(run);
    run.run("light");
    std::vector<ClvRay> rays(kRays);
    run.download("rays", std::span(rays));
    for (std::uint32_t i = 0; i < kRays; i += 127) {
        const vec4 u = clvSobol4(64 + i / (kRays / 2) * scene.constants.halfStep + clvNeighbourIndex(i % (kRays / 2), kRays / 2), 7);
        const ClvTexelPick pick = clvPickTexel(Sums{scene.sums}, RaysFrame::kSide, RaysFrame::kSide, vec2(u.x, u.y));
        ASSERT_EQ(rays[i].origin, scene.texels[pick.texel].position + scene.texels[pick.texel].normal * 1e-3f) << i;
    }
    EXPECT_EQ(device.messages(), std::vector<std::string>());
}

}  // namespace rays_test
