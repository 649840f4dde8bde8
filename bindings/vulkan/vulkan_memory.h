// Buffers and images of a frame: on the device, and where the host reaches them.
#pragma once
#include <memory>
#include <span>

#include "bindings/vulkan/vulkan_acceleration.h"
#include "clv/plan/frame.h"

namespace clv {

// A buffer or an image with memory of its own, which is freed after the last copy.
struct VulkanBuffer {
    struct Memory {
        vk::raii::DeviceMemory memory = nullptr;
        vk::raii::Buffer buffer = nullptr;
        vk::raii::Image image = nullptr;
        VulkanAcceleration acceleration;  // in the buffer, of one that holds an acceleration structure
    };
    std::shared_ptr<Memory> owner;
    vk::Buffer buffer;            // one of these is null
    vk::Image image;
    std::byte* mapped = nullptr;  // where the host reads and writes it, or null
};

enum class VulkanMemoryUse {
    device,    // passes alone
    upload,    // the host writes it, passes read it
    download,  // passes write it, the host reads it
};

struct VulkanBufferWish {
    vk::DeviceSize bytes = 0;
    vk::BufferUsageFlags usage;
    VulkanMemoryUse use = VulkanMemoryUse::device;
    bool onHost = false;  // in the host's memory, for copies to and from the device's
    FrameImage image{};   // not empty: an image
    vk::ImageUsageFlags imageUsage{};
};

// Takes memory for all of them. Buffers that the host reads or writes come mapped where the device's memory is the host's too.
// Throws std::runtime_error before any is taken where they need more than is free.
std::vector<VulkanBuffer> makeBuffers(const VulkanDevice::Impl& device, std::span<const VulkanBufferWish> wishes);

}  // namespace clv
