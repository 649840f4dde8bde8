#include "bindings/vulkan/vulkan_acceleration.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "bindings/vulkan/vulkan_words.h"

namespace clv {
namespace {

using Type = vk::AccelerationStructureTypeKHR;

constexpr vk::DeviceSize kAlignment = 256;  // of a structure in its buffer, as Vulkan wants it

// What a level is built from; a size is asked for with addresses that are null.
struct BuildLevel {
    vk::AccelerationStructureGeometryKHR geometry;
    vk::AccelerationStructureBuildGeometryInfoKHR build;
    vk::AccelerationStructureBuildRangeInfoKHR range;

    BuildLevel(Type type, const vk::AccelerationStructureGeometryKHR& of, std::uint64_t primitives) : geometry(of), range(std::uint32_t(primitives)) {
        build.type = type;
        build.flags = vk::BuildAccelerationStructureFlagBitsKHR::ePreferFastTrace;
        build.mode = vk::BuildAccelerationStructureModeKHR::eBuild;
    }
    const vk::AccelerationStructureBuildGeometryInfoKHR& info() { return build.setGeometries(geometry); }
};

BuildLevel triangleLevel(std::uint64_t triangles, vk::DeviceAddress corners) {
    const vk::AccelerationStructureGeometryTrianglesDataKHR data(vk::Format::eR32G32B32Sfloat, corners, kFrameCornerBytes / 3, std::uint32_t(3 * triangles - 1), vk::IndexType::eNoneKHR);
    return {Type::eBottomLevel, {vk::GeometryTypeKHR::eTriangles, data, vk::GeometryFlagBitsKHR::eOpaque}, triangles};
}

BuildLevel instanceLevel(vk::DeviceAddress instances) {
    return {Type::eTopLevel, {vk::GeometryTypeKHR::eInstances, vk::AccelerationStructureGeometryInstancesDataKHR(false, instances), vk::GeometryFlagBitsKHR::eOpaque}, 1};
}

vk::AccelerationStructureBuildSizesInfoKHR sizesOf(const VulkanDevice::Impl& device, BuildLevel level) {
    return device.device.getAccelerationStructureBuildSizesKHR(vk::AccelerationStructureBuildTypeKHR::eDevice, level.info(), level.range.primitiveCount);
}

// What comes before is over when what follows begins to read it.
void wait(const vk::raii::CommandBuffer& commands, vk::PipelineStageFlags stage, vk::AccessFlags written, vk::AccessFlags read) {
    commands.pipelineBarrier(stage, vk::PipelineStageFlagBits::eAccelerationStructureBuildKHR, {}, vk::MemoryBarrier(written, read), {}, {});
}

}  // namespace

void requireRayTracing(const VulkanDevice::Impl& device) {
    if (device.enabled.hasRayTracing()) return;
    throw std::runtime_error("Vulkan: " + device.info.name + (device.info.features.hasRayTracing() ? " has its ray tracing switched off" : " has no ray tracing"));
}

VulkanAccelerationSizes accelerationSizes(const VulkanDevice::Impl& device, std::uint64_t triangles) {
    requireRayTracing(device);
    const auto chain = device.physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceAccelerationStructurePropertiesKHR>();
    const vk::DeviceSize scratchAlignment = std::max<vk::DeviceSize>(chain.get<vk::PhysicalDeviceAccelerationStructurePropertiesKHR>().minAccelerationStructureScratchOffsetAlignment, kAlignment);
    const auto bottom = sizesOf(device, triangleLevel(triangles, 0)), top = sizesOf(device, instanceLevel(0));
    VulkanAccelerationSizes sizes;
    sizes.bottom = bottom.accelerationStructureSize, sizes.top = top.accelerationStructureSize;
    sizes.topOffset = rounded(sizes.bottom, kAlignment);
    sizes.instanceOffset = rounded(sizes.topOffset + sizes.top, kAlignment);
    sizes.scratchOffset = rounded(sizes.instanceOffset + sizeof(vk::AccelerationStructureInstanceKHR), scratchAlignment);
    sizes.bytes = rounded(sizes.scratchOffset + std::max(bottom.buildScratchSize, top.buildScratchSize), kAlignment);
    return sizes;
}

VulkanAcceleration makeAcceleration(const VulkanDevice::Impl& device, std::uint64_t triangles, vk::Buffer buffer, vk::DeviceSize bytes) {
    const VulkanAccelerationSizes sizes = accelerationSizes(device, triangles);
    if (bytes < sizes.bytes) throw std::runtime_error("an acceleration structure of " + std::to_string(triangles) + " triangles takes " + std::to_string(sizes.bytes) + " bytes, not " + std::to_string(bytes));
    return {{device.device, {{}, buffer, 0, sizes.bottom, Type::eBottomLevel}}, {device.device, {{}, buffer, sizes.topOffset, sizes.top, Type::eTopLevel}}};
}

void recordBuild(const VulkanDevice::Impl& device, const vk::raii::CommandBuffer& commands, std::uint64_t triangles, vk::Buffer corners, vk::Buffer buffer, const VulkanAcceleration& acceleration) {
    using Stage = vk::PipelineStageFlagBits;
    using Access = vk::AccessFlagBits;
    const VulkanAccelerationSizes sizes = accelerationSizes(device, triangles);
    const vk::DeviceAddress memory = addressOf(device, buffer);
    const auto build = [&](BuildLevel level, vk::AccelerationStructureKHR into) {
        level.build.setDstAccelerationStructure(into).setScratchData(memory + sizes.scratchOffset);
        commands.buildAccelerationStructuresKHR(level.info(), &level.range);
    };
    vk::AccelerationStructureInstanceKHR instance;
    instance.transform.matrix[0][0] = instance.transform.matrix[1][1] = instance.transform.matrix[2][2] = 1.0f;
    instance.mask = 0xff;
    instance.flags = VkGeometryInstanceFlagsKHR(vk::GeometryInstanceFlagBitsKHR::eTriangleFacingCullDisable);
    instance.accelerationStructureReference = device.device.getAccelerationStructureAddressKHR({*acceleration.bottom});
    commands.updateBuffer<vk::AccelerationStructureInstanceKHR>(buffer, sizes.instanceOffset, instance);
    build(triangleLevel(triangles, addressOf(device, corners)), *acceleration.bottom);
    wait(commands, Stage::eTransfer, Access::eTransferWrite, Access::eShaderRead);
    wait(commands, Stage::eAccelerationStructureBuildKHR, Access::eAccelerationStructureReadKHR | Access::eAccelerationStructureWriteKHR, Access::eAccelerationStructureReadKHR | Access::eAccelerationStructureWriteKHR);
    build(instanceLevel(memory + sizes.instanceOffset), *acceleration.top);
}

}  // namespace clv
