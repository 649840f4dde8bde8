// Devices are found, described and chosen, or there is one line that says why not.
#include <gtest/gtest.h>

#include <functional>

#include <vulkan/vulkan.h>

#include "bindings/vulkan/vulkan_device.h"
#include "vulkan/watched_vulkan.h"

using namespace clv;
using namespace clv::test;

namespace {

// Expects a std::runtime_error of one line that holds `words`.
void expectError(const std::function<void()>& f, const std::string& words) {
    try {
        f();
        ADD_FAILURE() << "no error with \"" << words << "\"";
    } catch (const std::runtime_error& error) {
        const std::string what = error.what();
        EXPECT_NE(what.find(words), std::string::npos) << what;
        EXPECT_TRUE(what.starts_with("Vulkan: ")) << what;
        EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    }
}

void expectNoDevice(const VulkanOptions& options, const std::string& words) {
    expectError([&] { VulkanDevice device(options); }, words);
}

VulkanOptions watchedOptions(const std::string& device = {}) { return {.device = device, .loader = watchedLoader()}; }

TEST(VulkanDevices, areThereForTheseTests) {
    const auto devices = vulkanDevices();
    ASSERT_FALSE(devices.empty());
    for (const VulkanDeviceInfo& info : devices) {
        EXPECT_NE(info.name, "");
        EXPECT_NE(info.driver, "");
        EXPECT_GE(info.apiVersion, VK_API_VERSION_1_1);
        EXPECT_GT(info.memory, std::uint64_t(1) << 20);
        // What Vulkan promises of every device.
        EXPECT_GE(info.limits.groups, 65535u);
        EXPECT_GE(info.limits.uniformBytes, 16384u);
        EXPECT_GE(info.limits.storageBytes, std::uint64_t(1) << 27);
        EXPECT_GE(info.limits.texelElements, 65536u);
    }
}

TEST(VulkanDevices, areChosenByIndexAndByAPartOfTheirName) {
    const auto devices = vulkanDevices();
    ASSERT_FALSE(devices.empty());
    const VulkanDeviceInfo& last = devices.back();
    EXPECT_EQ(VulkanDevice({.device = std::to_string(devices.size() - 1)}).info().name, last.name);
    EXPECT_EQ(VulkanDevice({.device = last.name.substr(1)}).info().name, last.name);
    EXPECT_NE(VulkanDevice().info().name, "");
}

TEST(VulkanDevices, countFromZero) {
    watchVulkan().devices = 2;
    EXPECT_EQ(vulkanDevices(watchedLoader()).size(), 2u);
    EXPECT_NE(VulkanDevice(watchedOptions("1")).info().name, "");
    expectNoDevice(watchedOptions("2"), "no device 2, they count from 0 to 1");
}

TEST(VulkanDevices, thatAreNotThereAreNamedBesideThoseThatAre) {
    expectNoDevice({.device = "no such device"}, "no device with \"no such device\" in its name; there is " + vulkanDevices().front().name);
    expectNoDevice({.device = "-1"}, "no device with \"-1\" in its name");
}

TEST(VulkanDevices, areMissedInOneLine) {
    expectNoDevice({.loader = "/nowhere/libvulkan.so"}, "no loader: /nowhere/libvulkan.so cannot be opened");
    expectNoDevice({.loader = "libm.so.6"}, "no loader: libm.so.6 has no vkGetInstanceProcAddr");
    expectError([] { vulkanDevices("/nowhere/libvulkan.so"); }, "no loader");
    WatchedVulkan& watched = watchVulkan();
    watched.failing = "vkCreateInstance", watched.failure = VK_ERROR_INCOMPATIBLE_DRIVER;
    expectNoDevice(watchedOptions(), "no driver is installed");
    watchVulkan().devices = 0;
    expectNoDevice(watchedOptions(), "no device with Vulkan 1.1 and compute");
    expectError([] { vulkanDevices(watchedLoader()); }, "no device with Vulkan 1.1 and compute");
    watchVulkan().oldDevices = true;
    expectNoDevice(watchedOptions(), "no device with Vulkan 1.1 and compute");
    watchVulkan();
    EXPECT_NE(VulkanDevice(watchedOptions()).info().name, "");
}

TEST(VulkanDevices, thatFailToOpenSaySo) {
    WatchedVulkan& watched = watchVulkan();
    watched.failing = "vkCreateDevice";
    watched.failure = VK_ERROR_OUT_OF_HOST_MEMORY;
    expectNoDevice(watchedOptions(), "the host is out of memory");
    watched.failure = VK_ERROR_DEVICE_LOST;
    expectNoDevice(watchedOptions(), "the device was lost");
    watched.failure = VK_ERROR_INITIALIZATION_FAILED;
    expectNoDevice(watchedOptions(), "InitializationFailed");
    watchVulkan();
}

TEST(VulkanFeatures, thatADeviceLacksAreMissedInOneLine) {
    watchVulkan().coreFeaturesOnly = true;
    const VulkanDevice device(watchedOptions());
    EXPECT_FALSE(device.info().features.floatAtomics);
    EXPECT_EQ(device.info().features.subgroupSize, 0u);
    EXPECT_FALSE(device.info().features.hasRayTracing());
    EXPECT_NE(device.info().driver, "");
    VulkanOptions options = watchedOptions();
    options.rayQueries = options.rayPipelines = true;
    expectError([&] { VulkanDevice(options).accelerationBytes(1); }, " has no ray tracing");
    options.floatAtomics = true;
    expectNoDevice(options, "cannot add floats in buffers atomically");
    watchVulkan();
}

TEST(VulkanFeatures, haveAFallback) {
    const auto traceOn = [](const std::string& type, bool queries, bool pipelines) {
        return defaultTrace({.name = "", .driver = "", .type = type, .limits = {}, .features = {.rayQueries = queries, .rayPipelines = pipelines}});
    };
    EXPECT_EQ(traceOn("discrete", true, true), TraceWay::query);
    EXPECT_EQ(traceOn("discrete", true, false), TraceWay::query);
    EXPECT_EQ(traceOn("discrete", false, true), TraceWay::pipeline);
    EXPECT_EQ(traceOn("discrete", false, false), TraceWay::walk);
    EXPECT_EQ(traceOn("cpu", true, true), TraceWay::walk);
    EXPECT_EQ(defaultInject({.floatAtomics = true, .subgroupSize = 32}), InjectWay::bricks);
    EXPECT_EQ(defaultInject({.floatAtomics = true, .subgroupSize = 8}), InjectWay::bricks);
    EXPECT_EQ(defaultInject({.floatAtomics = true, .subgroupSize = 4}), InjectWay::bricksPlain);
    EXPECT_EQ(defaultInject({.floatAtomics = false, .subgroupSize = 0}), InjectWay::bricksPlain);
    EXPECT_EQ(defaultInject({.floatAtomics = true, .subgroupSize = 32}, kClvInjectThesis), InjectWay::floatAtomics);
    EXPECT_EQ(defaultInject({.floatAtomics = false, .subgroupSize = 32}, kClvInjectThesis), InjectWay::fixedPoint);
}

TEST(VulkanDevice, takesItsWarningsFromTheValidationLayer) {
    const VulkanDevice device({.validate = true});
    EXPECT_EQ(device.messages(), std::vector<std::string>());
}

}  // namespace
