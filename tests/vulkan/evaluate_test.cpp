// Irradiance at still receivers is that of the CPU's lookup table, half by half.
#include <gtest/gtest.h>

#include "bindings/embree/visible_points.h"
#include "clv/cpu/lookup_table.h"
#include "support/rotation.h"
#include "vulkan/level_scene.h"

using namespace clv;
using namespace clv::test;

namespace {

constexpr std::uint32_t kRays = 4096, kReceivers = 500;

struct Lit {
    std::vector<float> history;     // both halves
    std::vector<vec4> irradiance;   // both halves
};

class VulkanEvaluate : public testing::Test {
protected:
    Lit evaluate(ShaderLanguage language, const DepositLayout& layout) {
        LightFrameSettings settings;
        settings.rays = kRays, settings.halves = 2, settings.receivers = receivers.size(), settings.inject = InjectWay::fixedPoint;
        settings.storage = layout.storage, settings.channels = std::uint32_t(layout.channels), settings.turned = layout.frame != mat3(1.0f);
        const BrickSlots bricks = brickSlots(level);
        settings.levels = {describeLevel(level, bricks)};
        settings.levels[0].lookupEntries = table.slots().size();
        VulkanFrame frame(device, lightFrame(settings), language);
        const std::vector<ClvRay> rays = testRays(level.volume, kRays);
        ClvFrame constants{};
        constants.rayCount = kRays, constants.halves = 2, constants.receiverCount = std::uint32_t(receivers.size());
        keepDirectionsAlong(layout.frame, constants);
        frame.upload("frame", constants);
        frame.upload("rays", std::span(rays));
        frame.upload("level 0", levelConstants(level, bricks, settings, 1.0f, 1.5f));
        uploadLevel(frame, settings, 0, level, bricks);
        uploadLookup(frame, 0, table);
        frame.upload("receivers", std::span(receivers));
        frame.run("light");
        frame.run("evaluate");
        Lit lit{std::vector<float>(2 * level.slots.size() * std::size_t(layout.stride())), std::vector<vec4>(2 * receivers.size())};
        frame.download("history 0", std::span(lit.history));
        frame.download("irradiance 0", std::span(lit.irradiance));
        return lit;
    }

    void expectWhatTheCpuReads(const DepositLayout& layout) {
        const Lit lit = evaluate(ShaderLanguage::glsl, layout);
        const std::size_t half = lit.history.size() / 2;
        int bright = 0;
        for (std::size_t i = 0; i < lit.irradiance.size(); ++i) {
            const std::size_t receiver = i % receivers.size(), h = i / receivers.size();
            const auto records = std::span(lit.history).subspan(h * half, half);
            // Both add the same products, in different orders: no further apart than their number times the rounding of their sizes.
            const std::size_t begin = receiver == 0 ? 0 : table.ends()[receiver - 1], end = table.ends()[receiver];
            float size = 0.0f;
            for (std::size_t k = begin; k < end; ++k) {
                for (int j = 0; j < layout.values(); ++j) size += std::abs(table.weights()[k] * records[table.slots()[k] * std::size_t(layout.stride()) + std::size_t(j)]);
            }
            const float bound = 2.0f * float((end - begin) + 9) * 0x1p-24f * size;
            const vec3 expected = table.irradiance(receiver, layout, records, layout.read(receivers[receiver].normal));
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(lit.irradiance[i][c], expected[c], bound) << "receiver " << receiver << ", half " << h;
            bright += expected.y > 0.0f;
        }
        EXPECT_GT(bright, int(receivers.size()));
        EXPECT_EQ(device.messages(), std::vector<std::string>());
    }

    VulkanDevice device{{.validate = true}};
    const Scene rooms = makeTwoRooms();
    const EmbreeScene embree{rooms};
    const Level level = twoRoomsLevel(embree, 16);
    const std::vector<ClvReceiver> receivers = visiblePoints(embree, kReceivers, 1);
    const LookupTable table{level, receivers, {}, serialFor()};
};

TEST_F(VulkanEvaluate, readsWhatTheCpuReads) {
    for (const std::uint32_t storage : {kClvStorageCube9, kClvStorageCube, kClvStorageSh1, kClvStorageSh2}) {
        for (const int channels : {1, 3}) {
            SCOPED_TRACE(testing::Message() << "storage " << storage << ", channels " << channels);
            expectWhatTheCpuReads({storage, channels});
        }
    }
}

TEST_F(VulkanEvaluate, readsDirectionsAlongTurnedAxes) { expectWhatTheCpuReads({kClvStorageCube9, 3, turned(0.6f, vec3(1.0f, 2.0f, 3.0f))}); }

TEST_F(VulkanEvaluate, isTheSameInBothLanguages) {
    for (const int channels : {1, 3}) {
        const DepositLayout layout{kClvStorageCube9, channels};
        EXPECT_EQ(evaluate(ShaderLanguage::glsl, layout).irradiance, evaluate(ShaderLanguage::hlsl, layout).irradiance);
    }
    EXPECT_EQ(device.messages(), std::vector<std::string>());
}

}  // namespace
