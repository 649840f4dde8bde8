// The history on the device follows the CPU's, to the last bit.
#include <gtest/gtest.h>

#include "clv/cpu/partial_volume.h"
#include "vulkan/level_scene.h"

using namespace clv;
using namespace clv::test;

namespace merge_test {

constexpr std::size_t kSlots = 77, kStride = 32, kHalves = 2, kValues = kSlots * kStride * kHalves;
constexpr ShaderLanguage kLanguages[] = {ShaderLanguage::glsl, ShaderLanguage::hlsl};

// One merge pass whose sums come from the host.
Frame mergeFrame(const std::string& shader) {
    Frame frame;
    frame.buffers = {{"frame", CLV_BIND_FRAME, sizeof(ClvFrame), FrameSource::host},
                     {"level", CLV_BIND_LEVEL, sizeof(ClvLevelFrame), FrameSource::host},
                     {"deposits", CLV_BIND_DEPOSITS, kValues * sizeof(float), FrameSource::host, true},
                     {"history", CLV_BIND_HISTORY, kValues * sizeof(float), FrameSource::zero, true}};
    const FrameUse both{2, FrameBinding::storage, FrameAccess::readWrite}, history{3, FrameBinding::storage, FrameAccess::readWrite};
    frame.steps = {{"light", {{"merge", shader, {{CLV_SPEC_STRIDE, kStride}}, {{0, FrameBinding::uniform}, {1, FrameBinding::uniform}, both, history}, groupsFor(kValues / 4), {}}}}};
    return frame;
}

// Sums of a frame, some of them negative.
std::vector<float> frameSums(int frame) {
    std::vector<float> sums(kValues);
    for (std::size_t i = 0; i < kValues; ++i) sums[i] = std::sin(float(i * 7 + std::size_t(frame) * 1000)) * 40.0f;
    return sums;
}

ClvLevelFrame constantsOf(int frame) {
    ClvLevelFrame constants{};
    constants.slotCount = kSlots, constants.scale = 1.0f / 12.0f, constants.weight = 1.0f / float(frame + 1), constants.fixedScale = 1024.0f;
    return constants;
}

class VulkanMerge : public testing::Test {
protected:
    void upload(VulkanFrame& run, int frame) {
        ClvFrame constants{};
        constants.halves = kHalves;
        run.upload("frame", constants);
        run.upload("level", constantsOf(frame));
    }
    VulkanDevice device{{.validate = true}};
};

TEST_F(VulkanMerge, movesTheHistoryAsTheCpuDoes) {
    for (const ShaderLanguage language : kLanguages) {
        VulkanFrame run(device, mergeFrame("merge"), language);
        std::vector<float> history(kValues), expected(kValues), left(kValues);
        for (int frame = 0; frame < 4; ++frame) {
            const std::vector<float> sums = frameSums(frame);
            upload(run, frame);
            run.upload("deposits", std::span(sums));
            run.run("light");
            std::vector<PartialVolume> partial(1);
            partial[0].deposits.assign(sums.begin(), sums.end());
            const ClvLevelFrame constants = constantsOf(frame);
            for (std::size_t slot = 0; slot < kSlots * kHalves; ++slot) {
                mergeDeposits(partial, slot, kStride, constants.scale, constants.weight, expected.data() + slot * kStride);
            }
            run.download("history", std::span(history));
            ASSERT_EQ(history, expected) << frame;
            run.download("deposits", std::span(left));
            ASSERT_EQ(left, std::vector<float>(kValues)) << "the sums were not cleared";
        }
        EXPECT_GT(std::abs(history[1]), 0.0f);
    }
    EXPECT_EQ(device.messages(), std::vector<std::string>());
}

TEST_F(VulkanMerge, takesIntegersForTheirUnits) {
    for (const ShaderLanguage language : kLanguages) {
        VulkanFrame run(device, mergeFrame("merge_fixed"), language);
        std::vector<float> history(kValues), expected(kValues);
        std::vector<int> left(kValues);
        for (int frame = 0; frame < 3; ++frame) {
            const ClvLevelFrame constants = constantsOf(frame);
            std::vector<int> units(kValues);
            const std::vector<float> sums = frameSums(frame);
            for (std::size_t i = 0; i < kValues; ++i) {
                units[i] = clvFixedFromFloat(sums[i], constants.fixedScale);
                expected[i] = clvMergeStep(expected[i], float(units[i]) * (constants.scale / constants.fixedScale), constants.weight);
                EXPECT_NEAR(float(units[i]) / constants.fixedScale, sums[i], 0.5f / constants.fixedScale);
            }
            upload(run, frame);
            run.upload("deposits", std::span<const int>(units));
            run.run("light");
            run.download("history", std::span(history));
            ASSERT_EQ(history, expected) << frame;
            run.download("deposits", std::span(left));
            ASSERT_EQ(left, std::vector<int>(kValues)) << "the sums were not cleared";
        }
    }
    EXPECT_EQ(device.messages(), std::vector<std::string>());
}

}  // namespace merge_test
