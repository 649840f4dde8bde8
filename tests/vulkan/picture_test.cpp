// A picture on the device: the surfaces that the host's rays meet, with the light that the CPU reads from the same volume.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "clv/stages/deferred.h"
#include "vulkan/whole_frame.h"

using namespace clv;
using namespace clv::test;

namespace picture_test {

constexpr std::uint32_t kRays = 16384;
constexpr uvec2 kSize(80, 48);
constexpr ClvPicture kPicture{.ambient = vec3(0.01f, 0.02f, 0.03f), .ambientThreshold = 0.5f, .width = kSize.x, .height = kSize.y, .pad0 = 0, .pad1 = 0};

struct Picture : WholeFrame {
    ClvMapFace camera;

    Picture(const std::string& name, int n) : WholeFrame(name, n, kRays) {
        const Camera& view = scene.cameras.front();
        camera = cameraFace(view.position, view.forward, view.up, view.yfov, float(kSize.x) / float(kSize.y), 1e-4f * length(scene.bounds.extent()));
        settings.picture = kSize;
    }

    struct Taken {
        std::vector<vec4> radiance;
        std::vector<float> history;
    };
    Taken take(InjectWay way, ShaderLanguage language = ShaderLanguage::glsl) {
        settings.inject = way;
        VulkanFrame frame(device, lightFrame(settings), language);
        uploadTo(frame);
        frame.upload("camera", camera);
        frame.upload("picture", kPicture);
        frame.run({"rsm", "light", "picture"});
        Taken taken{std::vector<vec4>(std::size_t(kSize.x) * kSize.y), std::vector<float>(kHalves * level.slots.size() * frameStride(settings))};
        frame.download("radiance", std::span(taken.radiance));
        frame.download("history 0", std::span(taken.history));
        return taken;
    }

    // What the CPU says from the same records.
    std::vector<vec4> onHost(std::span<const float> history) const {
        const DepositLayout layout{settings.storage, int(settings.channels)};
        const LookupOptions options{.lookup = kClvLookupTrilinear};
        const std::size_t perHalf = level.slots.size() * std::size_t(layout.stride());
        std::vector<vec4> radiance;
        for (uint i = 0; i < kSize.x * kSize.y; ++i) {
            ClvRay ray = clvPixelRay(camera, uvec2(i % kSize.x, i / kSize.x), kSize);
            ClvHit hit;
            embree.trace(std::span(&ray, 1), std::span(&hit, 1));
            radiance.push_back(vec4(0.0f));
            if (hit.primitive == kClvNoPrimitive) continue;
            const ClvReceiver receiver = clvReceiverOfHit(ray, hit);
            SlotWeights weights;
            lookupWeights(level, receiver, options, weights);
            vec3 irradiance(0.0f);
            for (std::size_t half = 0; half < kHalves; ++half) {
                irradiance += readIrradiance(layout, history.subspan(half * perHalf, perHalf), weights, layout.read(receiver.normal)) / float(kHalves);
            }
            radiance.back() = vec4(clvDeferredRadiance(hit.albedo, irradiance, kPicture), 1.0f);
        }
        return radiance;
    }
};

TEST(VulkanPicture, hasTheRadianceThatTheCpuReadsAtTheSamePixels) {
    for (const char* name : {"cornell", "two_rooms", "atrium"}) {
        for (const int n : {16, 32}) {
            SCOPED_TRACE(testing::Message() << name << " " << n);
            Picture picture(name, n);
            const Picture::Taken taken = picture.take(InjectWay::fixedPoint);
            const std::vector<vec4> expected = picture.onHost(taken.history);
            float brightest = 0.0f;
            for (const vec4& radiance : expected) brightest = std::max({brightest, radiance.x, radiance.y, radiance.z});
            std::size_t seen = 0, elsewhere = 0;
            for (std::size_t i = 0; i < expected.size(); ++i) {
                seen += expected[i].w > 0.0f;
                elsewhere += !(length(taken.radiance[i] - expected[i]) <= 1e-4f * brightest);
            }
            EXPECT_GT(seen, expected.size() / 2) << "the test says little";
            // A pixel whose middle lies on an outline may show what is on either side.
            EXPECT_LE(elsewhere, expected.size() / 500);
            EXPECT_EQ(picture.device.messages(), std::vector<std::string>());
        }
    }
}

TEST(VulkanPicture, isTheSameInBothLanguagesAndByEveryWayToInject) {
    Picture picture("two_rooms", 16);
    const Picture::Taken taken = picture.take(InjectWay::fixedPoint);
    EXPECT_TRUE(sameBits(picture.take(InjectWay::fixedPoint, ShaderLanguage::hlsl).radiance, taken.radiance));
    const Picture::Taken bricks = picture.take(InjectWay::bricksPlain);
    for (std::size_t i = 0; i < taken.radiance.size(); ++i) ASSERT_LT(length(bricks.radiance[i] - taken.radiance[i]), 1e-4f) << i;
    picture.settings.storage = kClvStorageCube, picture.settings.rule = kClvInjectThesis;
    float brightest = 0.0f;
    for (const vec4& radiance : picture.take(InjectWay::slices).radiance) brightest = std::max(brightest, radiance.x);
    EXPECT_GT(brightest, 0.0f);
    EXPECT_EQ(picture.device.messages(), std::vector<std::string>());
}

}  // namespace picture_test
