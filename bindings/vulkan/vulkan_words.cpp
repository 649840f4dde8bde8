#include "bindings/vulkan/vulkan_words.h"

namespace clv {

vk::Format vulkanFormat(FrameFormat format) {
    switch (format) {
        case FrameFormat::rgba32Float: return vk::Format::eR32G32B32A32Sfloat;
        case FrameFormat::rgba32Uint: return vk::Format::eR32G32B32A32Uint;
        case FrameFormat::r32Float: return vk::Format::eR32Sfloat;
        case FrameFormat::rgba16Float: return vk::Format::eR16G16B16A16Sfloat;
        case FrameFormat::r32Uint: return vk::Format::eR32Uint;
        case FrameFormat::depth32Float: return vk::Format::eD32Sfloat;
        default: return vk::Format::eUndefined;
    }
}

vk::DescriptorType descriptorType(FrameBinding binding) {
    switch (binding) {
        case FrameBinding::uniform: return vk::DescriptorType::eUniformBuffer;
        case FrameBinding::texel: return vk::DescriptorType::eUniformTexelBuffer;
        case FrameBinding::image: return vk::DescriptorType::eSampledImage;
        case FrameBinding::acceleration: return vk::DescriptorType::eAccelerationStructureKHR;
        default: return vk::DescriptorType::eStorageBuffer;
    }
}

// Of what a build reads or works in.
constexpr vk::BufferUsageFlags kBuildUsage = vk::BufferUsageFlagBits::eAccelerationStructureBuildInputReadOnlyKHR | vk::BufferUsageFlagBits::eShaderDeviceAddress | vk::BufferUsageFlagBits::eStorageBuffer;

vk::BufferUsageFlags bufferUsage(FrameBinding binding) {
    switch (binding) {
        case FrameBinding::uniform: return vk::BufferUsageFlagBits::eUniformBuffer;
        case FrameBinding::arguments: return vk::BufferUsageFlagBits::eIndirectBuffer;
        case FrameBinding::acceleration: return vk::BufferUsageFlagBits::eAccelerationStructureStorageKHR | kBuildUsage;
        case FrameBinding::corners: return kBuildUsage;
        // A frame that shares the buffer may use it the other way.
        default: return vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eUniformTexelBuffer;
    }
}

vk::ImageUsageFlags imageUsage(const FrameImage& image, FrameBinding binding) {
    if (binding != FrameBinding::target) return vk::ImageUsageFlagBits::eSampled;
    return image.format == FrameFormat::depth32Float ? vk::ImageUsageFlagBits::eDepthStencilAttachment : vk::ImageUsageFlagBits::eColorAttachment;
}

vk::ImageAspectFlags imageAspect(const FrameImage& image) {
    return image.format == FrameFormat::depth32Float ? vk::ImageAspectFlagBits::eDepth : vk::ImageAspectFlagBits::eColor;
}

vk::DeviceAddress addressOf(const VulkanDevice::Impl& device, vk::Buffer buffer) { return device.device.getBufferAddressKHR({buffer}); }

vk::DeviceSize rounded(vk::DeviceSize bytes, vk::DeviceSize alignment) { return (bytes + alignment - 1) / alignment * alignment; }

vk::PipelineStageFlags stageOf(const FramePass& pass) {
    if (pass.builds()) return vk::PipelineStageFlagBits::eAccelerationStructureBuildKHR | vk::PipelineStageFlagBits::eTransfer;
    if (pass.shader.empty()) return vk::PipelineStageFlagBits::eTransfer;
    if (pass.sendsRays()) return vk::PipelineStageFlagBits::eRayTracingShaderKHR;
    return pass.draws() ? vk::PipelineStageFlagBits::eAllGraphics : vk::PipelineStageFlagBits::eComputeShader;
}

vk::AccessFlags accessTo(const Frame& frame, const FramePass& pass, std::uint32_t buffer) {
    using Access = vk::AccessFlagBits;
    if (pass.builds()) return buffer == pass.uses[0].buffer ? vk::AccessFlags(Access::eShaderRead) : Access::eAccelerationStructureWriteKHR | Access::eTransferWrite;
    if (pass.shader.empty()) return Access::eTransferWrite;
    vk::AccessFlags flags;
    for (const FrameUse& use : pass.uses) {
        if (use.buffer != buffer) continue;
        if (use.binding == FrameBinding::target) {
            // Clears and blends are writes and reads of the same stage.
            const bool isDepth = frame.buffers[buffer].image.format == FrameFormat::depth32Float;
            flags |= isDepth ? Access::eDepthStencilAttachmentRead | Access::eDepthStencilAttachmentWrite : Access::eColorAttachmentRead | Access::eColorAttachmentWrite;
        } else if (use.binding == FrameBinding::arguments) {
            flags |= Access::eIndirectCommandRead;
        } else if (use.binding == FrameBinding::acceleration) {
            flags |= Access::eAccelerationStructureReadKHR;
        } else {
            if (frameReads(use.access)) flags |= use.binding == FrameBinding::uniform ? Access::eUniformRead : Access::eShaderRead;
            if (frameWrites(use.access)) flags |= Access::eShaderWrite;
        }
    }
    return flags;
}

}  // namespace clv
