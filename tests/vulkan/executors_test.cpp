// Inject, merge and evaluate by two executors that share nothing but the description: the same bits.
#include <gtest/gtest.h>

#include <cstring>

#include "vulkan/level_scene.h"
#include "vulkan/small_executor.h"

using namespace clv;
using namespace clv::test;

namespace {

constexpr std::uint32_t kRays = 4096, kReceivers = 200, kSlotsOfReceiver = 3;
constexpr float kLargestFlux = 1.5f;

struct LevelFrame {
    LightFrameSettings settings;
    Level level = openLevel();
    BrickSlots bricks = brickSlots(level);
    std::vector<ClvRay> rays = testRays(level.volume, kRays);
    std::vector<ClvReceiver> receivers;
    std::vector<uint> lookupEnds, lookupSlots;
    std::vector<float> lookupWeights;

    LevelFrame() {
        // Sums of integers do not depend on the order, which differs from run to run.
        settings.rays = kRays, settings.receivers = kReceivers, settings.halves = 2, settings.inject = InjectWay::fixedPoint;
        settings.levels = {describeLevel(level, bricks)};
        settings.levels[0].lookupEntries = kReceivers * kSlotsOfReceiver;
        for (std::uint32_t i = 0; i < kReceivers; ++i) {
            receivers.push_back({vec3(0.0f), 0.0f, normalize(vec3(1.0f, float(i), 2.0f)), 0.0f});
            for (std::uint32_t k = 0; k < kSlotsOfReceiver; ++k) {
                lookupSlots.push_back((7 * i + k) % uint(level.slots.size()));
                lookupWeights.push_back(1.0f + float(k));
            }
            lookupEnds.push_back(uint(lookupSlots.size()));
        }
    }
    Frame frame() const { return lightFrame(settings); }

    // The irradiance at all receivers, by both halves, after two frames.
    template <class Executor>
    std::vector<vec4> irradianceBy(Executor& executor) const {
        ClvFrame constants{};
        constants.rayCount = kRays, constants.halves = settings.halves, constants.receiverCount = kReceivers;
        executor.upload("frame", constants);
        executor.upload("rays", std::span<const ClvRay>(rays));
        executor.upload("table 0", std::span<const uint>(level.table));
        executor.upload("splits 0", std::span<const ClvSplit>(level.splits));
        executor.upload("receivers", std::span<const ClvReceiver>(receivers));
        executor.upload("lookup ends 0", std::span<const uint>(lookupEnds));
        executor.upload("lookup slots 0", std::span<const uint>(lookupSlots));
        executor.upload("lookup weights 0", std::span<const float>(lookupWeights));
        for (const float weight : {1.0f, 0.5f}) {
            executor.upload("level 0", levelConstants(level, bricks, settings, weight, kLargestFlux));
            executor.run("light");
        }
        executor.run("evaluate");
        std::vector<vec4> irradiance(settings.halves * kReceivers);
        executor.download("irradiance 0", std::span(irradiance));
        return irradiance;
    }
};

TEST(Executors, ofOneDescriptionGiveTheSameBits) {
    const LevelFrame scene;
    VulkanDevice device({.validate = true});
    VulkanFrame ours(device, scene.frame());
    SmallExecutor theirs(scene.frame());
    const std::vector<vec4> a = scene.irradianceBy(ours), b = scene.irradianceBy(theirs);
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(vec4)), 0);
    std::size_t lit = 0;
    for (const vec4& irradiance : a) lit += irradiance.y > 0.0f;
    EXPECT_GT(lit, a.size() / 2) << "the test says little";
    EXPECT_EQ(device.messages(), std::vector<std::string>());
}

}  // namespace
