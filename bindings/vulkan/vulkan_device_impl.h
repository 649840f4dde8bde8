// What the Vulkan back end's own files share of a device.
#pragma once
#include <mutex>

#include "bindings/vulkan/vulkan_device.h"
#include "bindings/vulkan/vulkan_loader.h"

namespace clv {

struct VulkanDevice::Impl {
    explicit Impl(const VulkanOptions& options);

    VulkanLoader loader;
    vk::raii::Context context;
    std::mutex messageMutex;
    std::vector<std::string> messages;
    vk::raii::Instance instance;
    vk::raii::DebugUtilsMessengerEXT messenger = nullptr;
    vk::raii::PhysicalDevice physical;
    VulkanDeviceInfo info;
    VulkanFeatures enabled;            // those of `info` that shaders may use
    std::uint32_t queueFamily = 0;
    float timestampPeriod = 0.0f;      // ns a tick; 0: the queue has no timestamps
    std::uint64_t timestampMask = 0;   // bits of a timestamp that count
    bool statesBudget = false;         // the driver says how much memory is free
    vk::raii::Device device = nullptr;
    vk::raii::Queue queue = nullptr;
};

}  // namespace clv
