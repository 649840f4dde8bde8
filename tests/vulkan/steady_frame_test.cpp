// A steady frame creates no object of Vulkan's and takes nothing from the heap.
#include <gtest/gtest.h>

#include "support/allocation_count.h"
#include "vulkan/rays_frame.h"
#include "vulkan/watched_vulkan.h"
#include "vulkan/whole_frame.h"

using namespace clv;
using namespace clv::test;

namespace {

// Creations of Vulkan's objects and what was taken from the heap while `frame(number)` runs the second, third and fourth time.
struct Taken {
    int first;
    int creations;
    std::size_t allocations;
};
template <class RunFrame>
Taken whatSteadyFramesTake(WatchedVulkan& watched, RunFrame&& frame) {
    frame(0);
    const int first = creations(watched);
    const std::size_t before = allocationCount();
    for (std::uint32_t number = 1; number < 4; ++number) frame(number);
    return {first, creations(watched) - first, allocationCount() - before};
}

TEST(SteadyFrame, takesNothing) {
    const RaysFrame scene;
    for (const bool separate : {false, true}) {
        WatchedVulkan& watched = watchVulkan();
        watched.separateMemory = separate;
        VulkanDevice device({.loader = watchedLoader()});
        VulkanFrame run(device, scene.frame);
        std::vector<ClvRay> rays(RaysFrame::kRays);
        const Taken taken = whatSteadyFramesTake(watched, [&](std::uint32_t) {
            scene.uploadTo(run);
            run.run({"clear", "light"});
            run.download("rays", std::span(rays));
        });
        EXPECT_GT(taken.first, 10);
        EXPECT_EQ(taken.creations, 0);
        EXPECT_EQ(taken.allocations, 0u);
    }
    watchVulkan();
}

TEST(SteadyFrame, takesNothingFromTheLightsToTheReceivers) {
    WholeFrame whole("cornell", 8, 1024);
    for (const InjectWay way : {InjectWay::bricks, InjectWay::bricksPlain, InjectWay::floatAtomics, InjectWay::fixedPoint}) {
        WatchedVulkan& watched = watchVulkan();
        VulkanDevice device({.floatAtomics = true, .loader = watchedLoader()});
        whole.settings.inject = way;
        VulkanFrame run(device, lightFrame(whole.settings));
        whole.uploadTo(run);
        std::vector<vec4> irradiance(WholeFrame::kHalves * whole.receivers.size());
        const Taken taken = whatSteadyFramesTake(watched, [&](std::uint32_t number) {
            whole.uploadConstants(run, number);
            run.run({"rsm", "light", "evaluate"});
            run.download("irradiance 0", std::span(irradiance));
        });
        EXPECT_GT(taken.first, 10);
        EXPECT_EQ(taken.creations, 0) << int(way);
        EXPECT_EQ(taken.allocations, 0u) << int(way);
    }
    watchVulkan();
}

}  // namespace
