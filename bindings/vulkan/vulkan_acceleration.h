// An acceleration structure in a buffer: a level of triangles, one instance of it, and room to build them.
#pragma once
#include "bindings/vulkan/vulkan_device_impl.h"

namespace clv {

// Where things lie in the buffer.
struct VulkanAccelerationSizes {
    vk::DeviceSize bottom = 0, top = 0;                 // bytes of the two levels
    vk::DeviceSize topOffset = 0, scratchOffset = 0, instanceOffset = 0;
    vk::DeviceSize bytes = 0;                           // of it all
};

// Throws std::runtime_error with one line where neither ray queries nor ray-tracing pipelines are switched on.
void requireRayTracing(const VulkanDevice::Impl& device);

VulkanAccelerationSizes accelerationSizes(const VulkanDevice::Impl& device, std::uint64_t triangles);

struct VulkanAcceleration {
    vk::raii::AccelerationStructureKHR bottom = nullptr, top = nullptr;
};

// In a buffer of at least accelerationSizes().bytes; throws std::runtime_error in a smaller one.
VulkanAcceleration makeAcceleration(const VulkanDevice::Impl& device, std::uint64_t triangles, vk::Buffer buffer, vk::DeviceSize bytes);

// Builds it from three corners of three floats a triangle.
void recordBuild(const VulkanDevice::Impl& device, const vk::raii::CommandBuffer& commands, std::uint64_t triangles, vk::Buffer corners, vk::Buffer buffer, const VulkanAcceleration& acceleration);

}  // namespace clv
