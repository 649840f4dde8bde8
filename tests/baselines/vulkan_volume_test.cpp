// The library on a Vulkan device behind the interface of the comparison: it gives the light of the CPU.
#include "benchmarks/baselines/vulkan_volume.h"

#include "baselines/method_run.h"
#include "benchmarks/baselines/light_volume.h"
#include "bindings/vulkan/vulkan_device.h"

namespace clv::test {
namespace {

class VulkanVolumeMethod : public testing::TestWithParam<const char*> {
protected:
    static VulkanVolumeSettings coarse() { return {.device = "0", .resolution = 12, .readers = Readers::receivers}; }
    void SetUp() override {
        try {
            vulkanDevices();
        } catch (const std::runtime_error& error) {
            GTEST_SKIP() << error.what();
        }
    }
};

TEST_P(VulkanVolumeMethod, givesTheLightOfTheCpu) {
    const MeasuredRoom room(GetParam(), 200, 1);
    const auto onDevice = makeVulkanVolume(coarse());
    const auto onCpu = makeLightVolume({.resolution = 12, .readers = Readers::receivers, .guided = false});
    onDevice->prepare(room.world(), room.points);
    onCpu->prepare(room.world(), room.points);
    // More rays than a submission takes, in two frames; twice, so that a restart leaves nothing behind.
    for (const std::uint32_t seed : {3u, 4u}) {
        const auto light = lightAfter(*onDevice, room, seed, 2, 80 << 10), expected = lightAfter(*onCpu, room, seed, 2, 80 << 10);
        EXPECT_LT(relativeErrors(light, expected).rmse, 2e-3) << GetParam();
        EXPECT_EQ(onDevice->raysTraced(), 160u << 10);
    }
    EXPECT_GT(onDevice->bytes(), 0u);
    expectNothingAfterRestart(*onDevice, room);
}

INSTANTIATE_TEST_SUITE_P(Rooms, VulkanVolumeMethod, testing::Values("two_rooms", "cornell"));

TEST(VulkanVolumeDevice, thatIsNoneIsSaidInOneLine) {
    const MeasuredRoom room("cornell", 10, 1);
    const auto method = makeVulkanVolume({.device = "no such device"});
    try {
        method->prepare(room.world(), room.points);
        FAIL() << "expected a std::runtime_error";
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
}

}  // namespace
}  // namespace clv::test
