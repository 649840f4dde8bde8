// What the Vulkan back end's own files share of a device.
#pragma once
#include <mutex>

#include <vulkan/vulkan_raii.hpp>

#include "bindings/vulkan/vulkan_device.h"

namespace clv {

struct VulkanDevice::Impl {
    vk::raii::Context context;
    std::mutex messageMutex;
    std::vector<std::string> messages;
    vk::raii::Instance instance = nullptr;
    vk::raii::DebugUtilsMessengerEXT messenger = nullptr;
    vk::raii::PhysicalDevice physical = nullptr;
    vk::raii::Device device = nullptr;
    vk::raii::Queue queue = nullptr;
    std::uint32_t queueFamily = 0;
    float timestampPeriod = 0.0f;  // ns a tick; 0: the queue has no timestamps
    VulkanDeviceInfo info;
};

}  // namespace clv
