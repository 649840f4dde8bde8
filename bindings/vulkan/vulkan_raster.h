// What a pass that draws has of Vulkan's: a render pass, and views and a framebuffer for each of its draws.
#pragma once
#include <span>
#include <vector>

#include "bindings/vulkan/vulkan_memory.h"
#include "clv/plan/frame.h"

namespace clv {

struct VulkanRaster {
    vk::raii::RenderPass renderPass = nullptr;
    std::vector<vk::raii::ImageView> views;             // the targets of the first layer, then those of the next
    std::vector<vk::raii::Framebuffer> framebuffers;    // a layer each
    vk::Extent2D extent;
    std::vector<vk::ClearValue> clears;                 // a target each
};

VulkanRaster makeRaster(const VulkanDevice::Impl& device, const Frame& frame, const FramePass& pass, std::span<const VulkanBuffer> buffers);

// `stages`: the vertex and the fragment shader.
vk::raii::Pipeline makeRasterPipeline(const VulkanDevice::Impl& device, const Frame& frame, const FramePass& pass, const VulkanRaster& raster,
                                      std::span<const vk::PipelineShaderStageCreateInfo> stages, vk::PipelineLayout layout);

// The draws of all layers; pipeline and descriptors are bound.
void recordDraws(const vk::raii::CommandBuffer& commands, const FramePass& pass, const VulkanRaster& raster, vk::PipelineLayout layout, std::span<const VulkanBuffer> buffers);

// What shaders know of a draw beside their descriptors: the number of the layer, in a push constant.
vk::PushConstantRange drawConstants();

}  // namespace clv
