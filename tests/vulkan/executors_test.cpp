// Frames by two executors that share nothing but the description: the same bits.
#include <gtest/gtest.h>

#include <cstring>

#include "vulkan/level_scene.h"
#include "vulkan/small_executor.h"
#include "vulkan/whole_frame.h"

using namespace clv;
using namespace clv::test;

namespace executors_test {

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

TEST(Executors, sayWhatTheyLeaveOut) {
    TracedScene traced(makeBuiltinScene("cornell"), 8, 64, false);
    traced.settings.accelerationBytes = 4096;
    for (const TraceWay way : {TraceWay::query, TraceWay::pipeline}) {
        traced.settings.trace = way;
        try {
            SmallExecutor executor(lightFrame(traced.settings));
            ADD_FAILURE() << "no error";
        } catch (const std::runtime_error& error) {
            EXPECT_EQ(error.what(), std::string("the frame has an acceleration structure, acceleration, which this executor leaves out"));
        }
    }
}

// A picture by all that draws: the lights' maps, the thesis' lines in slices, what the camera sees.
struct DrawnFrame : WholeFrame {
    static constexpr uvec2 kSize{64, 40};

    explicit DrawnFrame(InjectWay way) : WholeFrame("two_rooms", 8, 8192) {
        drawMaps(96);
        settings.receivers = 0, settings.picture = kSize, settings.inject = way;
        if (way == InjectWay::slices) settings.storage = kClvStorageCube, settings.rule = kClvInjectThesis;
    }

    template <class Executor>
    std::vector<vec4> pictureBy(Executor& executor) const {
        uploadScene(executor);
        executor.upload("level 0", levelConstants(level, bricks, settings, 1.0f, largestFlux));
        executor.upload("table 0", std::span<const uint>(level.table));
        executor.upload("splits 0", std::span<const ClvSplit>(level.splits));
        executor.upload("slots 0", std::span<const ClvSlot>(level.slots));
        const Camera& view = scene.cameras.front();
        executor.upload("camera", cameraFace(view.position, view.forward, view.up, view.yfov, float(kSize.x) / float(kSize.y), 1e-4f * length(scene.bounds.extent())));
        executor.upload("picture", ClvPicture{.ambient = vec3(0.01f), .ambientThreshold = 0.5f, .width = kSize.x, .height = kSize.y, .pad0 = 0, .pad1 = 0});
        for (const char* step : {"rsm", "light", "picture"}) executor.run(step);
        std::vector<vec4> radiance(kSize.x * kSize.y);
        executor.download("radiance", std::span(radiance));
        return radiance;
    }
};

TEST(Executors, drawTheSamePicture) {
    for (const InjectWay way : {InjectWay::fixedPoint, InjectWay::slices}) {
        DrawnFrame drawn(way);
        const Frame frame = lightFrame(drawn.settings);
        VulkanFrame ours(drawn.device, frame);
        SmallExecutor theirs(frame);
        const std::vector<vec4> a = drawn.pictureBy(ours), b = drawn.pictureBy(theirs);
        float brightest = 0.0f, difference = 0.0f;
        for (std::size_t i = 0; i < a.size(); ++i) brightest = std::max(brightest, a[i].y), difference = std::max(difference, length(a[i] - b[i]));
        EXPECT_GT(brightest, 0.0f) << "the test says little";
        // Lines come into the blend in an order that differs from run to run, and with it the rounding of sums.
        EXPECT_LE(difference, way == InjectWay::slices ? 1e-5f * brightest : 0.0f);
        EXPECT_EQ(drawn.device.messages(), std::vector<std::string>());
    }
}

}  // namespace executors_test
