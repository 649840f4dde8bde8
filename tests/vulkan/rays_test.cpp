// The rays pass draws the rays that the shared headers draw on the host.
#include <gtest/gtest.h>

#include "bindings/vulkan/vulkan_frame.h"
#include "clv/data/frame.h"
#include "clv/math/sobol.h"
#include "clv/stages/pick_texel.h"
#include "clv/stages/rays.h"

using namespace clv;

namespace {

TEST(VulkanRays, areThoseOfTheHost) {
    constexpr std::uint32_t kSide = 8, kRays = 4096;
    std::vector<ClvRsmTexel> texels(kSide * kSide);
    std::vector<float> sums;
    for (std::uint32_t i = 0; i < texels.size(); ++i) {
        texels[i] = {vec3(float(i), 1.0f, 2.0f), 0.25f, normalize(vec3(1.0f, float(i), 3.0f)), 1u, vec3(1.0f, 2.0f, 3.0f), 0.0f};
    }
    for (std::uint32_t row = 0; row <= kSide; ++row) {
        for (std::uint32_t i = 0; i <= kSide; ++i) sums.push_back(float(i) / kSide);
    }
    const ClvFrame constants{.boundsLo = vec3(0.0f), .rayCount = kRays, .boundsHi = vec3(1.0f), .halves = 2, .firstIndex = 64, .seed = 7,
                             .rsmPass = 0, .rsmSeed = 0, .rsmSide = kSide, .lightCount = 1, .receiverCount = 0, .originOffset = 1e-3f,
                             .pad0 = vec3(0.0f), .triangleCount = 0};
    Frame frame;
    frame.buffers = {{"frame", CLV_BIND_FRAME, sizeof(ClvFrame), FrameSource::host},
                     {"texels", CLV_BIND_TEXELS, texels.size() * sizeof(ClvRsmTexel), FrameSource::host},
                     {"sums", CLV_BIND_TEXEL_SUMS, sums.size() * sizeof(float), FrameSource::host},
                     {"rays", CLV_BIND_RAYS, kRays * sizeof(ClvRay), FrameSource::passes, true}};
    frame.steps = {{"light", {{"rays", "rays", {}, {{0, FrameBinding::uniform}, {1}, {2}, {3, FrameBinding::storage, FrameAccess::write}}, groupsFor(kRays), {}}}}};

    struct Sums {
        const std::vector<float>& sums;
        float clvReadTexelSum(uint i) const { return sums[i]; }
    };
    VulkanDevice device({.device = "", .validate = true});
    for (const ShaderLanguage language : {ShaderLanguage::glsl, ShaderLanguage::hlsl}) {
        VulkanFrame run(device, frame, language);
        run.upload("frame", constants);
        run.upload("texels", std::span<const ClvRsmTexel>(texels));
        run.upload("sums", std::span<const float>(sums));
        run.run("light");
        std::vector<ClvRay> rays(kRays);
        run.download("rays", std::span(rays));
        for (std::uint32_t i = 0; i < kRays; ++i) {
            const std::uint32_t perHalf = kRays / 2;
            const vec4 u = clvSobol4(64 + i % perHalf, clvHashCombine(7, i / perHalf));
            const ClvTexelPick pick = clvPickTexel(Sums{sums}, kSide, kSide, vec2(u.x, u.y));
            const ClvRay expected = clvRayFromTexel(texels[pick.texel], vec2(u.z, u.w), 1.0f / pick.probability, 1e-3f);
            ASSERT_EQ(rays[i].origin, expected.origin) << i;
            ASSERT_EQ(rays[i].flux, expected.flux) << i;
            ASSERT_NEAR(length(rays[i].direction - expected.direction), 0.0f, 1e-6f) << i;
        }
    }
    EXPECT_EQ(device.messages(), std::vector<std::string>());
}

}  // namespace
