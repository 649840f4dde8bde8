#include "bindings/vulkan/vulkan_raster.h"

#include <algorithm>

#include "bindings/vulkan/vulkan_words.h"

namespace clv {
namespace {

// Every image stays in this layout, which allows all that a frame does: no barrier needs to know what comes next.
constexpr vk::ImageLayout kLayout = vk::ImageLayout::eGeneral;

bool isDepth(const Frame& frame, const FrameUse& use) { return frame.buffers[use.buffer].image.format == FrameFormat::depth32Float; }

std::vector<FrameUse> targetsOf(const FramePass& pass) {
    std::vector<FrameUse> targets;
    std::copy_if(pass.uses.begin(), pass.uses.end(), std::back_inserter(targets), [](const FrameUse& use) { return use.binding == FrameBinding::target; });
    return targets;
}

vk::raii::RenderPass makeRenderPass(const VulkanDevice::Impl& device, const Frame& frame, std::span<const FrameUse> targets) {
    std::vector<vk::AttachmentDescription> attachments;
    std::vector<vk::AttachmentReference> colours;
    vk::AttachmentReference depth(VK_ATTACHMENT_UNUSED, vk::ImageLayout::eUndefined);
    for (const FrameUse& use : targets) {
        const vk::AttachmentReference reference(std::uint32_t(attachments.size()), kLayout);
        isDepth(frame, use) ? void(depth = reference) : colours.push_back(reference);
        const vk::AttachmentLoadOp load = use.access == FrameAccess::write ? vk::AttachmentLoadOp::eClear : vk::AttachmentLoadOp::eLoad;
        attachments.emplace_back(vk::AttachmentDescriptionFlags{}, vulkanFormat(frame.buffers[use.buffer].image.format), vk::SampleCountFlagBits::e1, load, vk::AttachmentStoreOp::eStore,
                                 vk::AttachmentLoadOp::eDontCare, vk::AttachmentStoreOp::eDontCare, kLayout, kLayout);
    }
    const vk::SubpassDescription subpass({}, vk::PipelineBindPoint::eGraphics, {}, colours, {}, &depth);
    // Draws come one after another where they share an image: the layers of one image of depths.
    using Stage = vk::PipelineStageFlagBits;
    const vk::PipelineStageFlags tests = Stage::eEarlyFragmentTests | Stage::eLateFragmentTests;
    const vk::AccessFlags access = vk::AccessFlagBits::eDepthStencilAttachmentRead | vk::AccessFlagBits::eDepthStencilAttachmentWrite;
    const vk::SubpassDependency afterDraws(VK_SUBPASS_EXTERNAL, 0, tests, tests, access, access);
    return {device.device, vk::RenderPassCreateInfo({}, attachments, subpass, afterDraws)};
}

vk::PipelineColorBlendAttachmentState blendState(FrameBlend blend) {
    using Factor = vk::BlendFactor;
    vk::PipelineColorBlendAttachmentState state(blend != FrameBlend::replace, Factor::eOne, Factor::eOne, vk::BlendOp::eAdd, Factor::eOne, Factor::eOne, vk::BlendOp::eAdd);
    if (blend == FrameBlend::addKeepLargestAlpha) state.alphaBlendOp = vk::BlendOp::eMax;
    using Component = vk::ColorComponentFlagBits;
    state.colorWriteMask = Component::eR | Component::eG | Component::eB | Component::eA;
    return state;
}

}  // namespace

VulkanRaster makeRaster(const VulkanDevice::Impl& device, const Frame& frame, const FramePass& pass, std::span<const VulkanBuffer> buffers) {
    VulkanRaster raster;
    const std::vector<FrameUse> targets = targetsOf(pass);
    raster.renderPass = makeRenderPass(device, frame, targets);
    raster.clears.resize(targets.size());
    const uvec3 extent = frame.buffers[targets.front().buffer].image.extent;
    raster.extent = vk::Extent2D(extent.x, extent.y);
    for (std::uint32_t layer = 0; layer < frameLayers(frame, pass); ++layer) {
        std::vector<vk::ImageView> views;
        for (const FrameUse& use : targets) {
            const FrameImage& image = frame.buffers[use.buffer].image;
            const vk::ImageSubresourceRange range(imageAspect(image), 0, 1, std::min(layer, image.extent.z - 1), 1);
            raster.views.emplace_back(device.device, vk::ImageViewCreateInfo({}, buffers[use.buffer].image, vk::ImageViewType::e2D, vulkanFormat(image.format), {}, range));
            views.push_back(*raster.views.back());
        }
        raster.framebuffers.emplace_back(device.device, vk::FramebufferCreateInfo({}, *raster.renderPass, views, extent.x, extent.y, 1));
    }
    return raster;
}

vk::raii::Pipeline makeRasterPipeline(const VulkanDevice::Impl& device, const Frame& frame, const FramePass& pass, const VulkanRaster& raster,
                                      std::span<const vk::PipelineShaderStageCreateInfo> stages, vk::PipelineLayout layout) {
    std::vector<vk::PipelineColorBlendAttachmentState> blends;
    bool tests = false;
    for (const FrameUse& use : targetsOf(pass)) isDepth(frame, use) ? void(tests = true) : blends.push_back(blendState(use.blend));
    const bool lines = pass.raster.topology == FrameTopology::lines;
    const vk::PipelineVertexInputStateCreateInfo noVertices;
    const vk::PipelineInputAssemblyStateCreateInfo assembly({}, lines ? vk::PrimitiveTopology::eLineList : vk::PrimitiveTopology::eTriangleList);
    // Upside down: y points up in the clip space of the description.
    const vk::Viewport area(0.0f, float(raster.extent.height), float(raster.extent.width), -float(raster.extent.height), 0.0f, 1.0f);
    const vk::Rect2D all({}, raster.extent);
    const vk::PipelineViewportStateCreateInfo viewport({}, area, all);
    vk::PipelineRasterizationStateCreateInfo rasterization;
    rasterization.lineWidth = 1.0f;
    const vk::PipelineRasterizationLineStateCreateInfoEXT diamonds(vk::LineRasterizationModeEXT::eBresenham);
    if (lines && device.enabled.diamondLines) rasterization.pNext = &diamonds;
    const vk::PipelineMultisampleStateCreateInfo oneSample;
    const vk::PipelineDepthStencilStateCreateInfo depth({}, tests, tests, vk::CompareOp::eGreater);
    const vk::PipelineColorBlendStateCreateInfo blend({}, false, {}, blends);
    vk::GraphicsPipelineCreateInfo info;
    info.setStages(stages).setPVertexInputState(&noVertices).setPInputAssemblyState(&assembly).setPViewportState(&viewport);
    info.setPRasterizationState(&rasterization).setPMultisampleState(&oneSample).setPDepthStencilState(&depth).setPColorBlendState(&blend);
    info.setLayout(layout).setRenderPass(*raster.renderPass);
    return {device.device, nullptr, info};
}

void recordDraws(const vk::raii::CommandBuffer& commands, const FramePass& pass, const VulkanRaster& raster, vk::PipelineLayout layout, std::span<const VulkanBuffer> buffers) {
    const auto arguments = std::find_if(pass.uses.begin(), pass.uses.end(), [](const FrameUse& use) { return use.binding == FrameBinding::arguments; });
    for (std::uint32_t layer = 0; layer < raster.framebuffers.size(); ++layer) {
        const vk::Rect2D all({}, raster.extent);
        commands.beginRenderPass({*raster.renderPass, *raster.framebuffers[layer], all, raster.clears}, vk::SubpassContents::eInline);
        commands.pushConstants<std::uint32_t>(layout, drawConstants().stageFlags, 0, layer);
        if (arguments == pass.uses.end()) {
            commands.draw(pass.raster.vertices, 1, 0, 0);
        } else {
            commands.drawIndirect(buffers[arguments->buffer].buffer, layer * sizeof(FrameDrawArguments), 1, sizeof(FrameDrawArguments));
        }
        commands.endRenderPass();
    }
}

vk::PushConstantRange drawConstants() { return {vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment, 0, sizeof(std::uint32_t)}; }

}  // namespace clv
