// The history of moving lights gives way by dynamicity as on the CPU; frames of still lights know nothing of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "bindings/vulkan/shader_interface.h"
#include "clv/cpu/partial_volume.h"
#include "clv/stages/merge.h"
#include "vulkan/level_scene.h"

using namespace clv;
using namespace clv::test;

namespace moving_lights_test {

constexpr std::uint32_t kRays = 2048, kHalves = 2;
constexpr int kFrames = 4;
constexpr float kLargestFlux = 1.5f;
constexpr ClvMergeSettings kMerge{.timestep = 0.1f, .stillTime = 20.0f, .movingTime = 0.05f, .dynamicityTime = 0.5f};
constexpr ShaderLanguage kLanguages[] = {ShaderLanguage::glsl, ShaderLanguage::hlsl};

// Other rays in each frame; one light of two has moved in the second frame alone.
std::vector<ClvRay> raysOfFrame(const ClvVolume& volume, int frame) {
    std::vector<ClvRay> rays = testRays(volume, kRays);
    std::rotate(rays.begin(), rays.begin() + 37 * frame, rays.end());
    for (std::size_t i = 0; i < rays.size(); ++i) rays[i].dynamicity = frame == 1 && i % 64 < 4 ? 0.2f + 0.2f * float(i % 64) : 0.0f;
    return rays;
}

struct History {
    std::vector<float> deposits, dynamicity, frames;  // both halves
};

History onHost(const Level& level, const DepositLayout& layout) {
    const std::size_t slots = level.slots.size(), stride = std::size_t(layout.stride());
    History history{std::vector<float>(kHalves * slots * stride), std::vector<float>(kHalves * slots * kSides), std::vector<float>(kHalves * slots)};
    for (int frame = 0; frame < kFrames; ++frame) {
        const std::vector<ClvRay> rays = raysOfFrame(level.volume, frame);
        for (std::size_t half = 0; half < kHalves; ++half) {
            std::vector<PartialVolume> partials(1);
            partials[0].resize(slots, layout, true);
            inject(level, layout, kClvInjectTrackLength, std::span(rays).subspan(half * kRays / kHalves, kRays / kHalves), partials[0].target());
            for (std::size_t slot = 0; slot < slots; ++slot) {
                const std::size_t i = half * slots + slot;
                const float largest = mergeDynamicity(kMerge, partials, slot, &history.dynamicity[i * kSides]);
                const float weight = clvMergeWeight(kMerge, largest, history.frames[i] + 1.0f);
                history.frames[i] = clvFramesFromWeight(weight);
                mergeDeposits(partials, slot, stride, float(kHalves) / kRays, weight, history.deposits.data() + i * stride);
            }
        }
    }
    return history;
}

History onDevice(VulkanDevice& device, ShaderLanguage language, InjectWay way, const Level& level, const DepositLayout& layout) {
    const BrickSlots bricks = brickSlots(level);
    LightFrameSettings settings;
    settings.rays = kRays, settings.halves = kHalves, settings.inject = way, settings.movingLights = true;
    settings.storage = layout.storage, settings.channels = std::uint32_t(layout.channels);
    settings.levels = {describeLevel(level, bricks)};
    VulkanFrame frame(device, lightFrame(settings), language);
    ClvFrame constants{};
    constants.rayCount = kRays, constants.halves = kHalves;
    frame.upload("frame", constants);
    frame.upload("merge settings 0", kMerge);
    frame.upload("level 0", levelConstants(level, bricks, settings, 1.0f, kLargestFlux));
    uploadLevel(frame, settings, 0, level, bricks);
    for (int k = 0; k < kFrames; ++k) {
        const std::vector<ClvRay> rays = raysOfFrame(level.volume, k);
        frame.upload("rays", std::span(rays));
        frame.run("light");
    }
    const std::size_t records = kHalves * level.slots.size();
    History history{std::vector<float>(records * std::size_t(layout.stride())), std::vector<float>(records * kSides), std::vector<float>(records)};
    frame.download("history 0", std::span(history.deposits));
    frame.download("kept dynamicity 0", std::span(history.dynamicity));
    frame.download("slot frames 0", std::span(history.frames));
    return history;
}

TEST(VulkanMovingLights, giveTheCpusHistory) {
    VulkanDevice device({.floatAtomics = true, .validate = true});
    const Scene rooms = makeTwoRooms();
    const EmbreeScene embree(rooms);
    for (const Level& level : {openLevel(), twoRoomsLevel(embree, 16)}) {
        const DepositLayout layout{kClvStorageCube9, 3};
        const History expected = onHost(level, layout);
        const float largest = std::abs(*std::max_element(expected.deposits.begin(), expected.deposits.end(), [](float a, float b) { return std::abs(a) < std::abs(b); }));
        // Some slots have moving light, some never had, and it has worn off since.
        EXPECT_GT(*std::max_element(expected.dynamicity.begin(), expected.dynamicity.end()), 0.4f);
        EXPECT_EQ(*std::min_element(expected.dynamicity.begin(), expected.dynamicity.end()), 0.0f);
        EXPECT_LT(*std::min_element(expected.frames.begin(), expected.frames.end()), 3.0f);
        EXPECT_NEAR(*std::max_element(expected.frames.begin(), expected.frames.end()), float(kFrames), 1e-5f);
        for (const InjectWay way : {InjectWay::floatAtomics, InjectWay::fixedPoint}) {
            for (const ShaderLanguage language : kLanguages) {
                SCOPED_TRACE(testing::Message() << level.slots.size() << " slots, way " << int(way) << ", language " << int(language));
                const History history = onDevice(device, language, way, level, layout);
                for (std::size_t k = 0; k < history.dynamicity.size(); ++k) ASSERT_NEAR(history.dynamicity[k], expected.dynamicity[k], 1e-5f) << k;
                // The device's exponential errs by 4e-6; weights are differences to 1 of it.
                for (std::size_t k = 0; k < history.frames.size(); ++k) ASSERT_NEAR(1.0f / history.frames[k], 1.0f / expected.frames[k], 2e-5f) << k;
                for (std::size_t k = 0; k < history.deposits.size(); ++k) ASSERT_NEAR(history.deposits[k], expected.deposits[k], 1e-4f * largest) << k;
            }
        }
    }
    EXPECT_EQ(device.messages(), std::vector<std::string>());
}

// Instructions of a shader, and how many of them are exponentials, which only decay needs.
struct Instructions {
    int all = 0, exponentials = 0;
};

Instructions instructionsOf(std::string_view shader, ShaderLanguage language) {
    constexpr std::uint32_t kHeaderWords = 5, kOpExtInst = 12, kExp = 27;  // of the SPIR-V specification and GLSL.std.450
    Instructions count;
    const auto words = shaderCode(shader, language);
    for (std::size_t at = kHeaderWords; at < words.size(); at += words[at] >> 16) {
        ++count.all;
        count.exponentials += (words[at] & 0xffffu) == kOpExtInst && words[at + 4] == kExp;
    }
    return count;
}

LightFrameSettings settingsFor(InjectWay way, bool movingLights) {
    LightFrameSettings settings;
    settings.lights = 1, settings.rsmSide = 8, settings.triangles = settings.bvhNodes = 4, settings.rays = 64, settings.receivers = 10;
    settings.inject = way, settings.movingLights = movingLights;
    LightFrameLevel level;
    level.volume.resolution = ivec3(4);
    level.cells = level.slots = 64, level.splits = 4, level.groupEnds = {8, 8, 8, 8, 8}, level.lookupEntries = 10;
    settings.levels = {level};
    return settings;
}

TEST(StillLights, haveNoDynamicityInTheirPassesShadersAndData) {
    const std::set<std::uint32_t> ofMovingLights{CLV_BIND_MERGE, CLV_BIND_DYNAMICITY, CLV_BIND_KEPT_DYNAMICITY, CLV_BIND_SLOT_FRAMES};
    for (const InjectWay way : {InjectWay::bricks, InjectWay::bricksPlain, InjectWay::floatAtomics, InjectWay::fixedPoint}) {
        const Frame frame = lightFrame(settingsFor(way, false));
        for (const FrameBuffer& buffer : frame.buffers) EXPECT_FALSE(ofMovingLights.contains(buffer.binding)) << buffer.name;
        int shaders = 0;
        for (const FrameStep& step : frame.steps) {
            for (const FramePass& pass : step.passes) {
                EXPECT_EQ(pass.name.find("scroll"), std::string::npos) << "one volume holds the scene";
                for (const std::string& name : frameShaders(pass)) {
                    for (const ShaderLanguage language : kLanguages) {
                        for (const ShaderBinding& binding : shaderInterface(shaderCode(name, language)).bindings) EXPECT_FALSE(ofMovingLights.contains(binding.number)) << name;
                        const bool merges = name.starts_with("merge") || name.starts_with("inject") || name == "evaluate";
                        EXPECT_EQ(merges ? instructionsOf(name, language).exponentials : 0, 0) << name;
                        ++shaders;
                    }
                }
            }
        }
        EXPECT_GT(shaders, 10);
    }
}

TEST(StillLights, spareTheInstructionsOfMovingOnes) {
    for (const ShaderLanguage language : kLanguages) {
        EXPECT_LT(instructionsOf("merge", language).all, instructionsOf("merge_moving", language).all);
        EXPECT_LT(instructionsOf("merge_fixed", language).all, instructionsOf("merge_fixed_moving", language).all);
        EXPECT_GT(instructionsOf("slot_frames", language).exponentials, 0) << "the test says little";
    }
    const std::size_t still = lightFrame(settingsFor(InjectWay::fixedPoint, false)).bytes(), moving = lightFrame(settingsFor(InjectWay::fixedPoint, true)).bytes();
    EXPECT_EQ(moving - still, sizeof(ClvMergeSettings) + 64 * (6 * sizeof(uint) + 6 * sizeof(float) + sizeof(float)));
}

}  // namespace moving_lights_test
