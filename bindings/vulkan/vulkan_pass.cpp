#include "bindings/vulkan/vulkan_pass.h"

#include <map>
#include <stdexcept>

#include "bindings/vulkan/shader_interface.h"
#include "bindings/vulkan/vulkan_words.h"

namespace clv {
namespace {

vk::ImageViewType viewType(FrameShape shape) {
    switch (shape) {
        case FrameShape::array: return vk::ImageViewType::e2DArray;
        case FrameShape::volume: return vk::ImageViewType::e3D;
        default: return vk::ImageViewType::e2D;
    }
}

// Of each of frameShaders(pass).
std::vector<vk::ShaderStageFlagBits> stagesOf(const FramePass& pass) {
    using Stage = vk::ShaderStageFlagBits;
    if (pass.draws()) return {Stage::eVertex, Stage::eFragment};
    if (pass.sendsRays()) return {Stage::eRaygenKHR, Stage::eMissKHR, Stage::eClosestHitKHR};
    return {Stage::eCompute};
}

vk::PipelineBindPoint bindPointOf(const FramePass& pass) {
    if (pass.sendsRays()) return vk::PipelineBindPoint::eRayTracingKHR;
    return pass.draws() ? vk::PipelineBindPoint::eGraphics : vk::PipelineBindPoint::eCompute;
}

// A pass's shaders, its constants among them.
struct Stages {
    std::vector<vk::raii::ShaderModule> modules;
    std::vector<vk::SpecializationMapEntry> entries;
    std::vector<std::uint32_t> values;
    vk::SpecializationInfo specialisation;
    std::vector<vk::PipelineShaderStageCreateInfo> infos;

    Stages(const VulkanDevice::Impl& device, const Frame& frame, const FramePass& pass, ShaderLanguage language) {
        for (const FrameConstant& constant : pass.constants) {
            entries.emplace_back(constant.id, std::uint32_t(values.size() * sizeof(std::uint32_t)), sizeof(std::uint32_t));
            values.push_back(constant.value);
        }
        specialisation.setMapEntries(entries).setData<std::uint32_t>(values);
        const std::vector<std::string> names = frameShaders(pass);
        const std::vector<vk::ShaderStageFlagBits> stages = stagesOf(pass);
        ShaderInterface needs;
        for (const std::string& name : names) needs = together(needs, shaderInterface(shaderCode(name, language)));
        throwFirst(shaderMismatches(frame, pass, needs, device.enabled));
        for (std::size_t i = 0; i < names.size(); ++i) {
            const auto words = shaderCode(names[i], language);
            modules.emplace_back(device.device, vk::ShaderModuleCreateInfo({}, words.size_bytes(), words.data()));
            infos.emplace_back(vk::PipelineShaderStageCreateFlags{}, stages[i], *modules.back(), "main", &specialisation);
        }
    }
    vk::ShaderStageFlags flags() const {
        vk::ShaderStageFlags all;
        for (const auto& info : infos) all |= info.stage;
        return all;
    }
};

void bind(const VulkanDevice::Impl& device, const FrameBuffer& description, const FrameUse& use, const VulkanBuffer& buffer, VulkanPass& made) {
    const vk::DescriptorBufferInfo whole(buffer.buffer, 0, VK_WHOLE_SIZE);
    vk::DescriptorImageInfo image;
    vk::WriteDescriptorSetAccelerationStructureKHR acceleration;
    vk::WriteDescriptorSet write(*made.set, description.binding, 0, 1, descriptorType(use.binding), &image, &whole);
    if (use.binding == FrameBinding::texel) {
        made.views.emplace_back(device.device, vk::BufferViewCreateInfo({}, buffer.buffer, vulkanFormat(use.format), 0, VK_WHOLE_SIZE));
        write.pTexelBufferView = &*made.views.back();
    }
    if (use.binding == FrameBinding::acceleration) {
        acceleration.setAccelerationStructures(*buffer.owner->acceleration.top);
        write.pNext = &acceleration;
    }
    if (use.binding == FrameBinding::image) {
        const std::uint32_t layers = description.image.shape == FrameShape::volume ? 1 : description.image.extent.z;
        const vk::ImageSubresourceRange range(imageAspect(description.image), 0, 1, 0, layers);
        made.imageViews.emplace_back(device.device, vk::ImageViewCreateInfo({}, buffer.image, viewType(description.image.shape), vulkanFormat(description.image.format), {}, range));
        image = vk::DescriptorImageInfo(nullptr, *made.imageViews.back(), vk::ImageLayout::eGeneral);
    }
    device.device.updateDescriptorSets(write, {});
}

}  // namespace

void throwFirst(const std::vector<std::string>& faults) {
    if (!faults.empty()) throw std::runtime_error("the frame cannot run: " + faults.front());
}

vk::raii::DescriptorPool makeDescriptorPool(const VulkanDevice::Impl& device, const Frame& frame) {
    std::map<vk::DescriptorType, std::uint32_t> counts;
    std::uint32_t sets = 0;
    for (const FrameStep& step : frame.steps) {
        for (const FramePass& pass : step.passes) {
            if (pass.shader.empty()) continue;
            ++sets;
            for (const FrameUse& use : pass.uses) counts[descriptorType(use.binding)] += frameBinds(use);
        }
    }
    if (sets == 0) return nullptr;
    std::vector<vk::DescriptorPoolSize> sizes;
    for (const auto& [type, count] : counts) {
        if (count > 0) sizes.emplace_back(type, count);
    }
    return {device.device, vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, sets, sizes)};
}

VulkanPass makePass(const VulkanDevice::Impl& device, const Frame& frame, const FramePass& pass, std::span<const VulkanBuffer> buffers,
                    const vk::raii::DescriptorPool& descriptors, ShaderLanguage language) {
    VulkanPass made;
    if (pass.shader.empty()) return made;
    const Stages stages(device, frame, pass, language);
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (const FrameUse& use : pass.uses) {
        if (frameBinds(use)) bindings.emplace_back(frame.buffers[use.buffer].binding, descriptorType(use.binding), 1, stages.flags());
    }
    made.setLayout = vk::raii::DescriptorSetLayout(device.device, {{}, bindings});
    vk::PipelineLayoutCreateInfo layout({}, *made.setLayout);
    const vk::PushConstantRange constants = drawConstants();
    if (pass.draws()) layout.setPushConstantRanges(constants);
    made.layout = vk::raii::PipelineLayout(device.device, layout);
    if (pass.draws()) {
        made.raster = makeRaster(device, frame, pass, buffers);
        made.pipeline = makeRasterPipeline(device, frame, pass, made.raster, stages.infos, *made.layout);
    } else if (pass.sendsRays()) {
        made.pipeline = makeRayPipeline(device, stages.infos, *made.layout);
        made.rays = makeShaderTable(device, made.pipeline);
    } else {
        made.pipeline = vk::raii::Pipeline(device.device, nullptr, vk::ComputePipelineCreateInfo({}, stages.infos.front(), *made.layout));
    }
    made.set = std::move(vk::raii::DescriptorSets(device.device, {*descriptors, *made.setLayout}).front());
    for (const FrameUse& use : pass.uses) {
        if (frameBinds(use)) bind(device, frame.buffers[use.buffer], use, buffers[use.buffer], made);
    }
    return made;
}

void recordPass(const VulkanDevice::Impl& device, const vk::raii::CommandBuffer& commands, const Frame& frame, const FrameStep& step, std::size_t p, const VulkanPass& made, std::span<const VulkanBuffer> buffers) {
    const FramePass& pass = step.passes[p];
    for (const FrameBarrier& barrier : pass.barriers) {
        const FramePass& earlier = step.passes[barrier.after];
        const vk::AccessFlags before = accessTo(frame, earlier, barrier.buffer), after = accessTo(frame, pass, barrier.buffer);
        if (frame.buffers[barrier.buffer].isImage()) {
            commands.pipelineBarrier(stageOf(earlier), stageOf(pass), {}, vk::MemoryBarrier(before, after), {}, {});
        } else {
            const vk::BufferMemoryBarrier memory(before, after, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, buffers[barrier.buffer].buffer, 0, VK_WHOLE_SIZE);
            commands.pipelineBarrier(stageOf(earlier), stageOf(pass), {}, {}, memory, {});
        }
    }
    if (pass.builds()) {
        const VulkanBuffer& structure = buffers[pass.uses[1].buffer];
        return recordBuild(device, commands, frame.buffers[pass.uses[1].buffer].triangles, buffers[pass.uses[0].buffer].buffer, structure.buffer, structure.owner->acceleration);
    }
    if (pass.shader.empty()) return recordClear(commands, frame.buffers[pass.uses[0].buffer], buffers[pass.uses[0].buffer]);
    const vk::PipelineBindPoint point = bindPointOf(pass);
    commands.bindPipeline(point, *made.pipeline);
    commands.bindDescriptorSets(point, *made.layout, 0, *made.set, {});
    if (pass.draws()) return recordDraws(commands, pass, made.raster, *made.layout, buffers);
    if (pass.sendsRays()) return recordRays(commands, pass, made.rays);
    commands.dispatch(pass.groups.x, pass.groups.y, pass.groups.z);
}

void recordClear(const vk::raii::CommandBuffer& commands, const FrameBuffer& description, const VulkanBuffer& buffer) {
    if (!description.isImage()) return commands.fillBuffer(buffer.buffer, 0, VK_WHOLE_SIZE, 0);
    const vk::ImageSubresourceRange all(imageAspect(description.image), 0, 1, 0, VK_REMAINING_ARRAY_LAYERS);
    commands.clearColorImage(buffer.image, vk::ImageLayout::eGeneral, vk::ClearColorValue(), all);
}

}  // namespace clv
