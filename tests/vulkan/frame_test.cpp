// A frame on a Vulkan device: data in, passes, data out, and what goes wrong on the way.
#include <gtest/gtest.h>

#include <cstring>
#include <functional>

#include <vulkan/vulkan.h>

#include "bindings/vulkan/vulkan_frame.h"
#include "vulkan/rays_frame.h"
#include "vulkan/small_executor.h"
#include "vulkan/watched_vulkan.h"

using namespace clv;
using namespace clv::test;

namespace frame_test {

bool sameBits(const std::vector<ClvRay>& a, const std::vector<ClvRay>& b) { return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(ClvRay)) == 0; }

bool isZero(const std::vector<ClvRay>& rays) { return sameBits(rays, std::vector<ClvRay>(rays.size(), ClvRay{})); }

void expectError(const std::function<void()>& f, const std::string& words) {
    try {
        f();
        ADD_FAILURE() << "no error with \"" << words << "\"";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
}

TEST(VulkanFrame, startsWithZeroedBuffersAndClearsThem) {
    const RaysFrame scene;
    VulkanDevice device({.validate = true});
    VulkanFrame run(device, scene.frame);
    EXPECT_TRUE(isZero(RaysFrame::raysOf(run)));
    scene.uploadTo(run);
    run.run("light");
    EXPECT_FALSE(isZero(RaysFrame::raysOf(run)));
    run.run("clear");
    EXPECT_TRUE(isZero(RaysFrame::raysOf(run)));
    EXPECT_EQ(device.messages(), std::vector<std::string>());
}

TEST(VulkanFrame, runsStepsInOneSubmissionInTheirOrder) {
    const RaysFrame scene;
    WatchedVulkan& watched = watchVulkan();
    VulkanDevice device({.validate = true, .loader = watchedLoader()});
    VulkanFrame run(device, scene.frame);
    scene.uploadTo(run);
    watched.calls.clear();
    run.run({"clear", "light"});
    EXPECT_EQ(watched.calls["vkQueueSubmit"], 1);
    const auto rays = RaysFrame::raysOf(run);
    EXPECT_FALSE(isZero(rays));
    run.run({"light", "clear"});
    EXPECT_TRUE(isZero(RaysFrame::raysOf(run)));
    run.run({"light", "clear", "light"});
    EXPECT_TRUE(sameBits(RaysFrame::raysOf(run), rays));
    EXPECT_EQ(device.messages(), std::vector<std::string>());
}

TEST(VulkanFrame, takesUploadsWithTheRunWhereTheHostDoesNotReachTheDevicesMemory) {
    const RaysFrame scene;
    std::vector<ClvRay> expected;
    for (const bool separate : {false, true}) {
        WatchedVulkan& watched = watchVulkan();
        watched.separateMemory = separate;
        VulkanDevice device({.validate = true, .loader = watchedLoader()});
        VulkanFrame run(device, scene.frame);
        scene.uploadTo(run);
        watched.calls.clear();
        run.run("light");
        EXPECT_EQ(watched.calls["vkQueueSubmit"], 1);
        const auto rays = RaysFrame::raysOf(run);
        EXPECT_EQ(watched.calls["vkQueueSubmit"], separate ? 2 : 1);
        EXPECT_FALSE(isZero(rays));
        if (separate) {
            EXPECT_TRUE(sameBits(rays, expected));
        }
        expected = rays;

        // A part of a buffer is replaced, the rest stays.
        auto texels = scene.texels;
        for (std::size_t i = 0; i < texels.size() / 2; ++i) texels[i].flux = vec3(7.0f);
        run.upload("texels", std::span<const ClvRsmTexel>(texels).first(texels.size() / 2));
        run.run("light");
        const auto changed = RaysFrame::raysOf(run);
        bool some = false, all = true;
        for (const ClvRay& ray : changed) {
            const bool replaced = ray.flux.x == ray.flux.y;
            some = some || replaced, all = all && replaced;
        }
        EXPECT_TRUE(some);
        EXPECT_FALSE(all);
        EXPECT_EQ(device.messages(), std::vector<std::string>());
    }
    watchVulkan();
}

TEST(VulkanFrame, takesTheMemoryThatTheFrameStates) {
    const RaysFrame scene;
    WatchedVulkan& watched = watchVulkan();
    VulkanDevice device({.loader = watchedLoader()});
    VulkanFrame run(device, scene.frame);
    // A buffer's memory is padded to whole pages at most.
    EXPECT_GE(watched.bytesTaken, scene.frame.bytes());
    EXPECT_LE(watched.bytesTaken, scene.frame.bytes() + scene.frame.buffers.size() * 4096);
}

TEST(VulkanFrame, doesNotTakeMemoryThatIsNotFree) {
    const RaysFrame scene;
    WatchedVulkan& watched = watchVulkan();
    watched.heapBytes = scene.frame.bytes() / 2;
    VulkanDevice device({.loader = watchedLoader()});
    expectError([&] { VulkanFrame run(device, scene.frame); }, "the frame takes 1 MiB of memory, of which " + device.info().name + " has 1 MiB free");
    EXPECT_EQ(watched.bytesTaken, 0u);
    watchVulkan();
}

TEST(VulkanFrame, endsInOneLineWhereTheDeviceRunsOutOfMemory) {
    const RaysFrame scene;
    WatchedVulkan& watched = watchVulkan();
    VulkanDevice device({.validate = true, .loader = watchedLoader()});
    watched.failing = "vkAllocateMemory", watched.failure = VK_ERROR_OUT_OF_DEVICE_MEMORY;
    expectError([&] { VulkanFrame run(device, scene.frame); }, "Vulkan: the device is out of memory");
    watched.failing = "vkCreateComputePipelines";
    expectError([&] { VulkanFrame run(device, scene.frame); }, "Vulkan: the device is out of memory");
    // Nothing was left behind: the next one runs.
    watched.failing.clear();
    VulkanFrame run(device, scene.frame);
    scene.uploadTo(run);
    run.run("light");
    EXPECT_FALSE(isZero(RaysFrame::raysOf(run)));
    EXPECT_EQ(device.messages(), std::vector<std::string>());
}

TEST(VulkanFrame, endsInOneLineWhereTheDeviceIsLost) {
    const RaysFrame scene;
    for (const char* function : {"vkQueueSubmit", "vkWaitForFences"}) {
        WatchedVulkan& watched = watchVulkan();
        VulkanDevice device({.loader = watchedLoader()});
        VulkanFrame run(device, scene.frame);
        watched.failing = function, watched.failure = VK_ERROR_DEVICE_LOST;
        expectError([&] { run.run("light"); }, "Vulkan: the device was lost");
    }
    WatchedVulkan& watched = watchVulkan();
    watched.separateMemory = true;
    VulkanDevice device({.loader = watchedLoader()});
    VulkanFrame run(device, scene.frame);
    watched.failing = "vkQueueSubmit", watched.failure = VK_ERROR_DEVICE_LOST;
    expectError([&] { RaysFrame::raysOf(run); }, "Vulkan: the device was lost");
    watchVulkan();
}

TEST(VulkanFrame, refusesADescriptionWithAFault) {
    VulkanDevice device;
    RaysFrame scene;
    scene.frame.steps[0].passes[0].groups.x = 0;
    expectError([&] { VulkanFrame run(device, scene.frame); }, "the frame cannot run: pass rays has no work groups");
    scene.frame.steps[0].passes[0] = RaysFrame().frame.steps[0].passes[0];
    scene.frame.buffers[1].bytes = device.info().limits.storageBytes + 4;
    expectError([&] { VulkanFrame run(device, scene.frame); }, "more than " + std::to_string(device.info().limits.storageBytes));
}

TEST(VulkanFrame, refusesAShaderThatDoesNotMatchItsPass) {
    VulkanDevice device({.validate = true});
    for (const ShaderLanguage language : {ShaderLanguage::glsl, ShaderLanguage::hlsl}) {
        RaysFrame scene;
        scene.frame.buffers[1].binding = CLV_BIND_HITS;
        expectError([&] { VulkanFrame run(device, scene.frame, language); }, "the frame cannot run: pass rays: the shader rays does not bind texels (binding 10)");
        scene = RaysFrame();
        scene.frame.steps[0].passes[0].shader = "no such shader";
        expectError([&] { VulkanFrame run(device, scene.frame, language); }, "shader no such shader");
    }
    EXPECT_EQ(device.messages(), std::vector<std::string>());
}

TEST(VulkanFrame, refusesDataThatDoesNotFit) {
    const RaysFrame scene;
    VulkanDevice device;
    VulkanFrame run(device, scene.frame);
    expectError([&] { run.upload("no such buffer", 1.0f); }, "the frame has no buffer no such buffer");
    expectError([&] { run.upload("rays", 1.0f); }, "rays is not the host's to fill");
    expectError([&] { run.upload("sums", std::span<const float>(std::vector<float>(scene.sums.size() + 1))); }, "buffer sums holds");
    std::vector<float> floats(1);
    expectError([&] { run.download("sums", std::span(floats)); }, "sums is not declared as one that the host reads back");
    expectError([&] { run.run("no such step"); }, "the frame has no step no such step");
    expectError([&] { run.run({"light", "no such step"}); }, "the frame has no step no such step");
    expectError([&] { run.times("no such step"); }, "the frame has no step no such step");
}

TEST(VulkanFrame, timesEachPassOfAStepThatHasRun) {
    const RaysFrame scene;
    VulkanDevice device;
    VulkanFrame run(device, scene.frame);
    EXPECT_TRUE(run.times("light").empty());
    scene.uploadTo(run);
    run.run("light");
    const auto times = run.times("light");
    ASSERT_EQ(times.size(), 1u);
    EXPECT_EQ(times[0].first, "rays");
    EXPECT_GT(times[0].second, 0.0);
    EXPECT_LT(times[0].second, 60e3);
}

// A frame of one step that clears what another frame lends it.
Frame clearingFrame(std::uint64_t bytes) {
    Frame frame;
    frame.buffers = {{"rays", CLV_BIND_RAYS, bytes, FrameSource::shared, true}};
    frame.steps = {{"clear", {{"clear", "", {}, {{0, FrameBinding::storage, FrameAccess::write}}, uvec3(1), {}}}}};
    return frame;
}

TEST(VulkanFrame, sharesBuffersOfAnotherFrame) {
    const RaysFrame scene;
    const std::uint64_t bytes = RaysFrame::kRays * sizeof(ClvRay);
    for (const bool separate : {false, true}) {
        WatchedVulkan& watched = watchVulkan();
        watched.separateMemory = separate;
        VulkanDevice device({.validate = true, .loader = watchedLoader()});
        auto lender = std::make_unique<VulkanFrame>(device, scene.frame);
        const std::uint64_t before = watched.bytesTaken;
        VulkanFrame borrower(device, clearingFrame(bytes), ShaderLanguage::glsl, lender.get());
        EXPECT_EQ(watched.bytesTaken, before + (separate ? bytes : 0)) << "more than the copy that the host reads";
        scene.uploadTo(*lender);
        lender->run("light");
        const auto rays = RaysFrame::raysOf(*lender);
        EXPECT_FALSE(isZero(rays));
        EXPECT_TRUE(sameBits(RaysFrame::raysOf(borrower), rays));
        borrower.run("clear");
        EXPECT_TRUE(isZero(RaysFrame::raysOf(*lender)));
        lender->run("light");
        lender.reset();
        EXPECT_TRUE(sameBits(RaysFrame::raysOf(borrower), rays)) << "what is shared ends with its last user";
        EXPECT_EQ(device.messages(), std::vector<std::string>());
    }
    watchVulkan();
}

TEST(VulkanFrame, refusesToShareWhatNobodyLends) {
    const RaysFrame scene;
    VulkanDevice device;
    VulkanFrame lender(device, scene.frame);
    const std::uint64_t bytes = RaysFrame::kRays * sizeof(ClvRay);
    expectError([&] { VulkanFrame run(device, clearingFrame(bytes)); }, "no frame lends " + std::to_string(bytes) + " bytes of buffer rays");
    expectError([&] { VulkanFrame run(device, clearingFrame(bytes + 4), ShaderLanguage::glsl, &lender); }, "no frame lends");
    Frame other = clearingFrame(bytes);
    other.buffers[0].name = "hits";
    expectError([&] { VulkanFrame run(device, other, ShaderLanguage::glsl, &lender); }, "of buffer hits");
}

// An executor that shares nothing with the back end but the description gives the same bits.
TEST(VulkanFrame, isWhatAnotherExecutorMakesOfTheDescription) {
    const RaysFrame scene;
    VulkanDevice device;
    VulkanFrame ours(device, scene.frame);
    SmallExecutor theirs(scene.frame);
    scene.uploadTo(ours);
    scene.uploadTo(theirs);
    ours.run("light");
    theirs.run("light");
    const auto rays = RaysFrame::raysOf(ours);
    EXPECT_FALSE(isZero(rays));
    EXPECT_TRUE(sameBits(rays, RaysFrame::raysOf(theirs)));
    theirs.run("clear");
    EXPECT_TRUE(isZero(RaysFrame::raysOf(theirs)));
}

}  // namespace frame_test
