// The rays pass draws the rays that the shared headers draw on the host.
#include <gtest/gtest.h>

#include "bindings/vulkan/vulkan_frame.h"
#include "clv/math/sobol.h"
#include "clv/stages/pick_texel.h"
#include "clv/stages/rays.h"
#include "vulkan/rays_frame.h"

using namespace clv;
using namespace clv::test;

namespace {

TEST(VulkanRays, areThoseOfTheHost) {
    const RaysFrame scene;
    const std::uint32_t kRays = RaysFrame::kRays, kSide = RaysFrame::kSide;
    struct Sums {
        const std::vector<float>& sums;
        float clvReadTexelSum(uint i) const { return sums[i]; }
    };
    VulkanDevice device({.device = "", .validate = true});
    for (const ShaderLanguage language : {ShaderLanguage::glsl, ShaderLanguage::hlsl}) {
        VulkanFrame run(device, scene.frame, language);
        scene.uploadTo(run);
        run.run("light");
        const std::vector<ClvRay> rays = RaysFrame::raysOf(run);
        for (std::uint32_t i = 0; i < kRays; ++i) {
            const std::uint32_t perHalf = kRays / 2;
            const vec4 u = clvSobol4(64 + i / perHalf * perHalf + clvNeighbourIndex(i % perHalf, perHalf), 7);
            const ClvTexelPick pick = clvPickTexel(Sums{scene.sums}, kSide, kSide, vec2(u.x, u.y));
            const ClvRay expected = clvRayFromTexel(scene.texels[pick.texel], vec2(u.z, u.w), 1.0f / pick.probability, 1e-3f);
            ASSERT_EQ(rays[i].origin, expected.origin) << i;
            ASSERT_EQ(rays[i].flux, expected.flux) << i;
            ASSERT_NEAR(length(rays[i].direction - expected.direction), 0.0f, 1e-6f) << i;
        }
    }
    EXPECT_EQ(device.messages(), std::vector<std::string>());
}

}  // namespace
