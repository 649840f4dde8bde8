#include "bindings/vulkan/vulkan_rays.h"

#include <algorithm>

#include "bindings/vulkan/vulkan_words.h"

namespace clv {

vk::PhysicalDeviceRayTracingPipelinePropertiesKHR rayPropertiesOf(const vk::raii::PhysicalDevice& device) {
    return device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceRayTracingPipelinePropertiesKHR>().get<vk::PhysicalDeviceRayTracingPipelinePropertiesKHR>();
}

vk::raii::Pipeline makeRayPipeline(const VulkanDevice::Impl& device, std::span<const vk::PipelineShaderStageCreateInfo> stages, vk::PipelineLayout layout) {
    using Group = vk::RayTracingShaderGroupTypeKHR;
    constexpr std::uint32_t kNone = VK_SHADER_UNUSED_KHR;
    const std::array<vk::RayTracingShaderGroupCreateInfoKHR, 3> groups{{{Group::eGeneral, 0, kNone, kNone, kNone}, {Group::eGeneral, 1, kNone, kNone, kNone}, {Group::eTrianglesHitGroup, kNone, 2, kNone, kNone}}};
    vk::RayTracingPipelineCreateInfoKHR info;
    info.setStageCount(std::uint32_t(stages.size())).setPStages(stages.data()).setGroups(groups).setMaxPipelineRayRecursionDepth(1).setLayout(layout);
    return {device.device, nullptr, nullptr, info};
}

VulkanShaderTable makeShaderTable(const VulkanDevice::Impl& device, const vk::raii::Pipeline& pipeline) {
    const auto properties = rayPropertiesOf(device.physical);
    const vk::DeviceSize handle = properties.shaderGroupHandleSize, alignment = properties.shaderGroupBaseAlignment, stride = rounded(handle, alignment);
    VulkanShaderTable table;
    const std::uint32_t count = std::uint32_t(table.regions.size());
    const std::vector<std::uint8_t> handles = pipeline.getRayTracingShaderGroupHandlesKHR<std::uint8_t>(0, count, count * handle);
    table.records.resize(count * stride);
    for (std::uint32_t i = 0; i < count; ++i) std::copy_n(handles.begin() + std::ptrdiff_t(i * handle), handle, table.records.begin() + std::ptrdiff_t(i * stride));
    // Nothing promises that a buffer begins where a table may.
    const VulkanBufferWish wish{.bytes = table.records.size() + alignment, .usage = vk::BufferUsageFlagBits::eShaderBindingTableKHR | vk::BufferUsageFlagBits::eShaderDeviceAddress | vk::BufferUsageFlagBits::eTransferDst};
    table.buffer = makeBuffers(device, std::span(&wish, 1)).front();
    const vk::DeviceAddress begin = addressOf(device, table.buffer.buffer), first = rounded(begin, alignment);
    table.offset = first - begin;
    for (std::uint32_t i = 0; i < count; ++i) table.regions[i] = vk::StridedDeviceAddressRegionKHR(first + i * stride, stride, stride);
    return table;
}

void recordShaderTable(const vk::raii::CommandBuffer& commands, const VulkanShaderTable& table) {
    if (!table.records.empty()) commands.updateBuffer<std::uint8_t>(table.buffer.buffer, table.offset, table.records);
}

void recordRays(const vk::raii::CommandBuffer& commands, const FramePass& pass, const VulkanShaderTable& table) {
    const uvec3 threads = frameThreads(pass);
    commands.traceRaysKHR(table.regions[0], table.regions[1], table.regions[2], {}, threads.x, threads.y, threads.z);
}

}  // namespace clv
