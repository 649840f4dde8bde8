// A pass of a frame as Vulkan's objects: a pipeline, its descriptors, and commands.
#pragma once
#include <span>
#include <vector>

#include "bindings/vulkan/vulkan_raster.h"
#include "bindings/vulkan/vulkan_rays.h"
#include "shaders/shader_code.h"

namespace clv {

struct VulkanPass {
    vk::raii::DescriptorSetLayout setLayout = nullptr;
    vk::raii::PipelineLayout layout = nullptr;
    vk::raii::Pipeline pipeline = nullptr;
    std::vector<vk::raii::BufferView> views;
    std::vector<vk::raii::ImageView> imageViews;
    vk::raii::DescriptorSet set = nullptr;
    VulkanRaster raster;    // of a pass that draws
    VulkanShaderTable rays; // of a pass that sends rays
};

// Descriptors of all passes; null where no pass has any.
vk::raii::DescriptorPool makeDescriptorPool(const VulkanDevice::Impl& device, const Frame& frame);

// A pass without a shader has no objects of its own. Throws std::runtime_error where a shader does not match.
VulkanPass makePass(const VulkanDevice::Impl& device, const Frame& frame, const FramePass& pass, std::span<const VulkanBuffer> buffers,
                    const vk::raii::DescriptorPool& descriptors, ShaderLanguage language);

// Pass `p` of the step, behind its barriers.
void recordPass(const VulkanDevice::Impl& device, const vk::raii::CommandBuffer& commands, const Frame& frame, const FrameStep& step, std::size_t p, const VulkanPass& made, std::span<const VulkanBuffer> buffers);

// Sets the buffer or image to 0.
void recordClear(const vk::raii::CommandBuffer& commands, const FrameBuffer& description, const VulkanBuffer& buffer);

// Throws the first of the faults, if there is one.
void throwFirst(const std::vector<std::string>& faults);

}  // namespace clv
