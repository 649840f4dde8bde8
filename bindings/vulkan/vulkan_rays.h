// What a pass that sends rays has of Vulkan's: a ray-tracing pipeline, and a table that says where its shaders are.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bindings/vulkan/vulkan_memory.h"
#include "clv/plan/frame.h"

namespace clv {

// A record for ray generation, one for miss, and one for closest hit, each a shader's handle.
struct VulkanShaderTable {
    VulkanBuffer buffer;
    vk::DeviceSize offset = 0;                                    // of the first record in the buffer
    std::vector<std::uint8_t> records;                            // what belongs there
    std::array<vk::StridedDeviceAddressRegionKHR, 3> regions;  // a record each
};

// Of a device that has ray-tracing pipelines.
vk::PhysicalDeviceRayTracingPipelinePropertiesKHR rayPropertiesOf(const vk::raii::PhysicalDevice& device);

// `stages`: ray generation, miss, closest hit.
vk::raii::Pipeline makeRayPipeline(const VulkanDevice::Impl& device, std::span<const vk::PipelineShaderStageCreateInfo> stages, vk::PipelineLayout layout);

VulkanShaderTable makeShaderTable(const VulkanDevice::Impl& device, const vk::raii::Pipeline& pipeline);

// Fills the table's buffer, before any pass runs; nothing where the pass has no table.
void recordShaderTable(const vk::raii::CommandBuffer& commands, const VulkanShaderTable& table);

// Pipeline and descriptors are bound.
void recordRays(const vk::raii::CommandBuffer& commands, const FramePass& pass, const VulkanShaderTable& table);

}  // namespace clv
