// Images and passes that draw, of the executor that shares no code with bindings/vulkan.
#include <algorithm>

#include "vulkan/small_executor.h"

namespace clv::test {
namespace {

VkImageAspectFlags aspectOf(const FrameImage& image) { return image.format == FrameFormat::depth32Float ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT; }

}  // namespace

SmallExecutor::Buffer SmallExecutor::makeImage(const FrameBuffer& description) const {
    const FrameImage& image = description.image;
    const bool isVolume = image.shape == FrameShape::volume, isDepth = image.format == FrameFormat::depth32Float;
    VkImageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.flags = isVolume ? VK_IMAGE_CREATE_2D_ARRAY_COMPATIBLE_BIT : 0;
    info.imageType = isVolume ? VK_IMAGE_TYPE_3D : VK_IMAGE_TYPE_2D;
    info.format = formatOf(image.format);
    info.extent = {image.extent.x, image.extent.y, isVolume ? image.extent.z : 1};
    info.mipLevels = 1;
    info.arrayLayers = isVolume ? 1 : image.extent.z;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = (isDepth ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT);
    Buffer made;
    check(vkCreateImage(device_, &info, nullptr, &made.image));
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(device_, made.image, &needs);
    made.memory = takeMemory(needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    check(vkBindImageMemory(device_, made.image, made.memory, 0));
    return made;
}

// Every image is put into the layout in which it stays.
void SmallExecutor::layOutImages() const {
    begin();
    for (std::size_t i = 0; i < buffers_.size(); ++i) {
        if (!frame_.buffers[i].isImage()) continue;
        const VkImageSubresourceRange all{aspectOf(frame_.buffers[i].image), 0, 1, 0, VK_REMAINING_ARRAY_LAYERS};
        const VkImageMemoryBarrier barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER, nullptr, 0, 0, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, buffers_[i].image, all};
        vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, 0, 0, nullptr, 0, nullptr, 1, &barrier);
    }
    submit();
}

VkImageView SmallExecutor::makeView(std::uint32_t buffer, VkImageViewType type, std::uint32_t firstLayer, std::uint32_t layers) const {
    const FrameImage& image = frame_.buffers[buffer].image;
    const VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO, nullptr, 0, buffers_[buffer].image, type, formatOf(image.format), {}, {aspectOf(image), 0, 1, firstLayer, layers}};
    VkImageView view = VK_NULL_HANDLE;
    check(vkCreateImageView(device_, &info, nullptr, &view));
    return view;
}

std::vector<FrameUse> SmallExecutor::targetsOf(const FramePass& description) const {
    std::vector<FrameUse> targets;
    for (const FrameUse& use : description.uses) {
        if (use.binding == FrameBinding::target) targets.push_back(use);
    }
    return targets;
}

// And a framebuffer for each layer.
void SmallExecutor::makeRenderPass(const FramePass& description, Pass& pass) const {
    const std::vector<FrameUse> targets = targetsOf(description);
    std::vector<VkAttachmentDescription> attachments;
    std::vector<VkAttachmentReference> colours;
    VkAttachmentReference depth{VK_ATTACHMENT_UNUSED, VK_IMAGE_LAYOUT_UNDEFINED};
    for (const FrameUse& use : targets) {
        const VkAttachmentReference reference{std::uint32_t(attachments.size()), VK_IMAGE_LAYOUT_GENERAL};
        if (isDepth(use)) depth = reference;
        if (!isDepth(use)) colours.push_back(reference);
        const VkAttachmentLoadOp load = use.access == FrameAccess::write ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
        attachments.push_back({0, formatOf(frame_.buffers[use.buffer].image.format), VK_SAMPLE_COUNT_1_BIT, load, VK_ATTACHMENT_STORE_OP_STORE, VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_DONT_CARE,
                               VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_GENERAL});
    }
    const VkSubpassDescription subpass{0, VK_PIPELINE_BIND_POINT_GRAPHICS, 0, nullptr, std::uint32_t(colours.size()), colours.data(), nullptr, &depth, 0, nullptr};
    const VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO, nullptr, 0, std::uint32_t(attachments.size()), attachments.data(), 1, &subpass, 0, nullptr};
    check(vkCreateRenderPass(device_, &info, nullptr, &pass.renderPass));
    const uvec3 extent = frame_.buffers[targets.front().buffer].image.extent;
    for (std::uint32_t layer = 0; layer < frameLayers(frame_, description); ++layer) {
        std::vector<VkImageView> views;
        for (const FrameUse& use : targets) views.push_back(makeView(use.buffer, VK_IMAGE_VIEW_TYPE_2D, std::min(layer, frame_.buffers[use.buffer].image.extent.z - 1), 1));
        pass.imageViews.insert(pass.imageViews.end(), views.begin(), views.end());
        const VkFramebufferCreateInfo framebuffer{VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO, nullptr, 0, pass.renderPass, std::uint32_t(views.size()), views.data(), extent.x, extent.y, 1};
        check(vkCreateFramebuffer(device_, &framebuffer, nullptr, &pass.framebuffers.emplace_back()));
    }
}

void SmallExecutor::makeDrawPipeline(const FramePass& description, const VkSpecializationInfo& constants, Pass& pass) const {
    std::vector<VkPipelineColorBlendAttachmentState> blends;
    VkBool32 tests = VK_FALSE;
    for (const FrameUse& use : targetsOf(description)) {
        if (isDepth(use)) {
            tests = VK_TRUE;
            continue;
        }
        const VkBlendOp alpha = use.blend == FrameBlend::addKeepLargestAlpha ? VK_BLEND_OP_MAX : VK_BLEND_OP_ADD;
        blends.push_back({use.blend != FrameBlend::replace, VK_BLEND_FACTOR_ONE, VK_BLEND_FACTOR_ONE, VK_BLEND_OP_ADD, VK_BLEND_FACTOR_ONE, VK_BLEND_FACTOR_ONE, alpha, 0xf});
    }
    const VkPipelineShaderStageCreateInfo stages[] = {makeStage(description.shader + ".vert", constants, VK_SHADER_STAGE_VERTEX_BIT), makeStage(description.shader + ".frag", constants, VK_SHADER_STAGE_FRAGMENT_BIT)};
    const bool lines = description.raster.topology == FrameTopology::lines;
    const uvec3 extent = frame_.buffers[targetsOf(description).front().buffer].image.extent;
    // The largest depth wins, and y points up.
    const VkViewport area{0.0f, float(extent.y), float(extent.x), -float(extent.y), 0.0f, 1.0f};
    const VkRect2D all{{0, 0}, {extent.x, extent.y}};
    const VkPipelineVertexInputStateCreateInfo noVertices{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO, nullptr, 0, 0, nullptr, 0, nullptr};
    const VkPipelineInputAssemblyStateCreateInfo assembly{VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO, nullptr, 0, lines ? VK_PRIMITIVE_TOPOLOGY_LINE_LIST : VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST, VK_FALSE};
    const VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO, nullptr, 0, 1, &area, 1, &all};
    const VkPipelineRasterizationLineStateCreateInfoEXT diamonds{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_LINE_STATE_CREATE_INFO_EXT, nullptr, VK_LINE_RASTERIZATION_MODE_BRESENHAM_EXT, VK_FALSE, 0, 0};
    VkPipelineRasterizationStateCreateInfo raster{};
    raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    raster.pNext = lines && diamondLines_ ? &diamonds : nullptr;
    raster.lineWidth = 1.0f;
    VkPipelineMultisampleStateCreateInfo samples{};
    samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    VkPipelineDepthStencilStateCreateInfo depth{};
    depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
    depth.depthTestEnable = depth.depthWriteEnable = tests;
    depth.depthCompareOp = VK_COMPARE_OP_GREATER;
    VkPipelineColorBlendStateCreateInfo blend{};
    blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    blend.attachmentCount = std::uint32_t(blends.size()), blend.pAttachments = blends.data();
    VkGraphicsPipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.stageCount = 2, info.pStages = stages;
    info.pVertexInputState = &noVertices, info.pInputAssemblyState = &assembly, info.pViewportState = &viewport;
    info.pRasterizationState = &raster, info.pMultisampleState = &samples, info.pDepthStencilState = &depth, info.pColorBlendState = &blend;
    info.layout = pass.layout, info.renderPass = pass.renderPass;
    check(vkCreateGraphicsPipelines(device_, VK_NULL_HANDLE, 1, &info, nullptr, &pass.pipeline));
    for (const auto& stage : stages) vkDestroyShaderModule(device_, stage.module, nullptr);
}

void SmallExecutor::recordDraws(const FramePass& description, const Pass& pass) const {
    const std::vector<FrameUse> targets = targetsOf(description);
    const std::vector<VkClearValue> zeroes(targets.size());
    const uvec3 extent = frame_.buffers[targets.front().buffer].image.extent;
    for (std::uint32_t layer = 0; layer < pass.framebuffers.size(); ++layer) {
        if (layer > 0) wait();  // layers share the image of depths
        const VkRenderPassBeginInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO, nullptr, pass.renderPass, pass.framebuffers[layer], {{0, 0}, {extent.x, extent.y}}, std::uint32_t(zeroes.size()), zeroes.data()};
        vkCmdBeginRenderPass(commands_, &info, VK_SUBPASS_CONTENTS_INLINE);
        vkCmdPushConstants(commands_, pass.layout, VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof layer, &layer);
        if (description.raster.vertices > 0) vkCmdDraw(commands_, description.raster.vertices, 1, 0, 0);
        for (const FrameUse& use : description.uses) {
            if (use.binding == FrameBinding::arguments) vkCmdDrawIndirect(commands_, buffers_[use.buffer].handle, layer * sizeof(FrameDrawArguments), 1, sizeof(FrameDrawArguments));
        }
        vkCmdEndRenderPass(commands_);
    }
}

}  // namespace clv::test
