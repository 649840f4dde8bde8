// The words of a frame's description in Vulkan's.
#pragma once
#include "bindings/vulkan/vulkan_device_impl.h"
#include "clv/plan/frame.h"

namespace clv {

vk::Format vulkanFormat(FrameFormat format);
vk::DescriptorType descriptorType(FrameBinding binding);
vk::BufferUsageFlags bufferUsage(FrameBinding binding);
vk::ImageUsageFlags imageUsage(const FrameImage& image, FrameBinding binding);
vk::ImageAspectFlags imageAspect(const FrameImage& image);

vk::DeviceAddress addressOf(const VulkanDevice::Impl& device, vk::Buffer buffer);
// The next multiple of the alignment.
vk::DeviceSize rounded(vk::DeviceSize bytes, vk::DeviceSize alignment);

// Stages in which the pass touches anything.
vk::PipelineStageFlags stageOf(const FramePass& pass);
// How the pass touches the buffer or image.
vk::AccessFlags accessTo(const Frame& frame, const FramePass& pass, std::uint32_t buffer);

}  // namespace clv
