#include "vulkan/small_executor.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "shaders/shader_code.h"

namespace clv::test {
namespace {

VkDescriptorType typeOf(FrameBinding binding) {
    if (binding == FrameBinding::uniform) return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    if (binding == FrameBinding::image) return VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
    return binding == FrameBinding::texel ? VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

VkImageViewType viewOf(FrameShape shape) {
    if (shape == FrameShape::volume) return VK_IMAGE_VIEW_TYPE_3D;
    return shape == FrameShape::array ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
}

}  // namespace

void check(VkResult result) {
    if (result != VK_SUCCESS) throw std::runtime_error("Vulkan refuses with " + std::to_string(result));
}

VkFormat formatOf(FrameFormat format) {
    switch (format) {
        case FrameFormat::r32Float: return VK_FORMAT_R32_SFLOAT;
        case FrameFormat::r32Uint: return VK_FORMAT_R32_UINT;
        case FrameFormat::rgba32Uint: return VK_FORMAT_R32G32B32A32_UINT;
        case FrameFormat::rgba16Float: return VK_FORMAT_R16G16B16A16_SFLOAT;
        case FrameFormat::depth32Float: return VK_FORMAT_D32_SFLOAT;
        default: return VK_FORMAT_R32G32B32A32_SFLOAT;
    }
}

SmallExecutor::SmallExecutor(const Frame& frame, bool floatAtomics) : frame_(frame) {
    for (const FrameBuffer& buffer : frame_.buffers) {
        if (buffer.isAcceleration()) throw std::runtime_error("the frame has an acceleration structure, " + buffer.name + ", which this executor leaves out");
    }
    openDevice(floatAtomics);
    for (const FrameBuffer& buffer : frame_.buffers) buffers_.push_back(buffer.isImage() ? makeImage(buffer) : makeBuffer(buffer));
    layOutImages();
    for (const FrameStep& step : frame_.steps) {
        steps_.emplace_back();
        for (const FramePass& pass : step.passes) steps_.back().push_back(pass.shader.empty() ? Pass() : makePass(pass));
    }
}

SmallExecutor::~SmallExecutor() {
    for (const auto& step : steps_) {
        for (const Pass& pass : step) {
            for (const VkBufferView view : pass.views) vkDestroyBufferView(device_, view, nullptr);
            for (const VkFramebuffer framebuffer : pass.framebuffers) vkDestroyFramebuffer(device_, framebuffer, nullptr);
            for (const VkImageView view : pass.imageViews) vkDestroyImageView(device_, view, nullptr);
            vkDestroyRenderPass(device_, pass.renderPass, nullptr);
            vkDestroyDescriptorPool(device_, pass.pool, nullptr);
            vkDestroyPipeline(device_, pass.pipeline, nullptr);
            vkDestroyPipelineLayout(device_, pass.layout, nullptr);
            vkDestroyDescriptorSetLayout(device_, pass.setLayout, nullptr);
        }
    }
    for (const Buffer& buffer : buffers_) {
        vkDestroyBuffer(device_, buffer.handle, nullptr);
        vkDestroyImage(device_, buffer.image, nullptr);
        vkFreeMemory(device_, buffer.memory, nullptr);
    }
    vkDestroyCommandPool(device_, commandPool_, nullptr);
    vkDestroyDevice(device_, nullptr);
    vkDestroyInstance(instance_, nullptr);
}

void SmallExecutor::openDevice(bool floatAtomics) {
    VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, .pNext = nullptr, .pApplicationName = "clv", .applicationVersion = 1, .pEngineName = "clv", .engineVersion = 1, .apiVersion = VK_API_VERSION_1_1};
    VkInstanceCreateInfo instance{};
    instance.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    instance.pApplicationInfo = &application;
    check(vkCreateInstance(&instance, nullptr, &instance_));
    std::uint32_t one = 1;
    const VkResult found = vkEnumeratePhysicalDevices(instance_, &one, &physical_);
    if (found != VK_INCOMPLETE) check(found);

    std::uint32_t count = 0, family = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, families.data());
    constexpr VkQueueFlags kWork = VK_QUEUE_COMPUTE_BIT | VK_QUEUE_GRAPHICS_BIT;
    while (family < count && (families[family].queueFlags & kWork) != kWork) ++family;
    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, nullptr, 0, family, 1, &priority};
    VkPhysicalDeviceShaderAtomicFloatFeaturesEXT atomics{};
    atomics.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_ATOMIC_FLOAT_FEATURES_EXT;
    VkPhysicalDeviceLineRasterizationFeaturesEXT lines{};
    lines.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_LINE_RASTERIZATION_FEATURES_EXT;
    VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &lines, {}};
    vkGetPhysicalDeviceFeatures2(physical_, &features);  // an extension that is not there leaves its features at no
    diamondLines_ = lines.bresenhamLines;
    lines = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_LINE_RASTERIZATION_FEATURES_EXT, nullptr, VK_FALSE, diamondLines_, VK_FALSE, VK_FALSE, VK_FALSE, VK_FALSE};
    atomics.shaderBufferFloat32AtomicAdd = VK_TRUE;
    std::vector<const char*> extensions;
    void* chain = nullptr;
    if (floatAtomics) chain = &atomics, extensions.push_back(VK_EXT_SHADER_ATOMIC_FLOAT_EXTENSION_NAME);
    if (diamondLines_) lines.pNext = chain, chain = &lines, extensions.push_back(VK_EXT_LINE_RASTERIZATION_EXTENSION_NAME);
    VkDeviceCreateInfo device{};
    device.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    device.queueCreateInfoCount = 1;
    device.pQueueCreateInfos = &queue;
    device.pNext = chain, device.enabledExtensionCount = std::uint32_t(extensions.size()), device.ppEnabledExtensionNames = extensions.data();
    check(vkCreateDevice(physical_, &device, nullptr, &device_));
    vkGetDeviceQueue(device_, family, 0, &queue_);
    const VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT, family};
    check(vkCreateCommandPool(device_, &pool, nullptr, &commandPool_));
    const VkCommandBufferAllocateInfo commands{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, commandPool_, VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
    check(vkAllocateCommandBuffers(device_, &commands, &commands_));
}

VkDeviceMemory SmallExecutor::takeMemory(const VkMemoryRequirements& needs, VkMemoryPropertyFlags wanted) const {
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(physical_, &memory);
    std::uint32_t type = 0;
    while ((memory.memoryTypes[type].propertyFlags & wanted) != wanted || !(needs.memoryTypeBits >> type & 1u)) ++type;
    const VkMemoryAllocateInfo allocation{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size, type};
    VkDeviceMemory taken = VK_NULL_HANDLE;
    check(vkAllocateMemory(device_, &allocation, nullptr, &taken));
    return taken;
}

SmallExecutor::Buffer SmallExecutor::makeBuffer(const FrameBuffer& description) const {
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = description.bytes;
    info.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
                 VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
    Buffer buffer{};
    check(vkCreateBuffer(device_, &info, nullptr, &buffer.handle));
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device_, buffer.handle, &needs);
    buffer.memory = takeMemory(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    check(vkBindBufferMemory(device_, buffer.handle, buffer.memory, 0));
    void* mapped = nullptr;
    check(vkMapMemory(device_, buffer.memory, 0, VK_WHOLE_SIZE, 0, &mapped));
    buffer.mapped = static_cast<std::byte*>(mapped);
    if (description.source == FrameSource::zero) std::memset(mapped, 0, description.bytes);
    return buffer;
}

SmallExecutor::Pass SmallExecutor::makePass(const FramePass& description) const {
    Pass pass;
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    std::vector<VkDescriptorPoolSize> sizes;
    for (const FrameUse& use : description.uses) {
        if (!frameBinds(use)) continue;
        bindings.push_back({frame_.buffers[use.buffer].binding, typeOf(use.binding), 1, VK_SHADER_STAGE_ALL, nullptr});
        sizes.push_back({typeOf(use.binding), 1});
    }
    const VkDescriptorSetLayoutCreateInfo setLayout{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, nullptr, 0, std::uint32_t(bindings.size()), bindings.data()};
    check(vkCreateDescriptorSetLayout(device_, &setLayout, nullptr, &pass.setLayout));
    const VkPushConstantRange layer{VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof(std::uint32_t)};
    const VkPipelineLayoutCreateInfo layout{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, nullptr, 0, 1, &pass.setLayout, description.draws() ? 1u : 0u, &layer};
    check(vkCreatePipelineLayout(device_, &layout, nullptr, &pass.layout));

    std::vector<VkSpecializationMapEntry> entries;
    for (std::uint32_t i = 0; i < description.constants.size(); ++i) {
        entries.push_back({description.constants[i].id, std::uint32_t(i * sizeof(FrameConstant) + offsetof(FrameConstant, value)), sizeof(std::uint32_t)});
    }
    const VkSpecializationInfo constants{std::uint32_t(entries.size()), entries.data(), description.constants.size() * sizeof(FrameConstant), description.constants.data()};
    if (description.draws()) {
        makeRenderPass(description, pass);
        makeDrawPipeline(description, constants, pass);
    } else {
        const VkPipelineShaderStageCreateInfo stage = makeStage(description.shader, constants, VK_SHADER_STAGE_COMPUTE_BIT);
        const VkComputePipelineCreateInfo pipeline{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO, nullptr, 0, stage, pass.layout, VK_NULL_HANDLE, 0};
        check(vkCreateComputePipelines(device_, VK_NULL_HANDLE, 1, &pipeline, nullptr, &pass.pipeline));
        vkDestroyShaderModule(device_, stage.module, nullptr);
    }

    const VkDescriptorPoolCreateInfo pool{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO, nullptr, 0, 1, std::uint32_t(sizes.size()), sizes.data()};
    check(vkCreateDescriptorPool(device_, &pool, nullptr, &pass.pool));
    const VkDescriptorSetAllocateInfo set{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, nullptr, pass.pool, 1, &pass.setLayout};
    check(vkAllocateDescriptorSets(device_, &set, &pass.set));
    for (const FrameUse& use : description.uses) {
        if (frameBinds(use)) bind(pass, use);
    }
    return pass;
}

VkPipelineShaderStageCreateInfo SmallExecutor::makeStage(const std::string& shader, const VkSpecializationInfo& constants, VkShaderStageFlagBits stage) const {
    const auto words = shaderCode(shader, ShaderLanguage::glsl);
    const VkShaderModuleCreateInfo code{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, nullptr, 0, words.size_bytes(), words.data()};
    VkShaderModule module;
    check(vkCreateShaderModule(device_, &code, nullptr, &module));
    return {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, nullptr, 0, stage, module, "main", &constants};
}

void SmallExecutor::bind(Pass& pass, const FrameUse& use) const {
    const VkDescriptorBufferInfo whole{buffers_[use.buffer].handle, 0, VK_WHOLE_SIZE};
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET, nullptr, pass.set, frame_.buffers[use.buffer].binding, 0, 1, typeOf(use.binding), nullptr, &whole, nullptr};
    if (use.binding == FrameBinding::texel) {
        const VkBufferViewCreateInfo view{VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO, nullptr, 0, whole.buffer, formatOf(use.format), 0, VK_WHOLE_SIZE};
        pass.views.emplace_back();
        check(vkCreateBufferView(device_, &view, nullptr, &pass.views.back()));
        write.pTexelBufferView = &pass.views.back();
    }
    VkDescriptorImageInfo image{VK_NULL_HANDLE, VK_NULL_HANDLE, VK_IMAGE_LAYOUT_GENERAL};
    if (use.binding == FrameBinding::image) {
        const FrameImage& read = frame_.buffers[use.buffer].image;
        pass.imageViews.push_back(makeView(use.buffer, viewOf(read.shape), 0, read.shape == FrameShape::volume ? 1 : read.extent.z));
        image.imageView = pass.imageViews.back();
        write.pImageInfo = &image;
    }
    vkUpdateDescriptorSets(device_, 1, &write, 0, nullptr);
}

void SmallExecutor::record(const FramePass& description, const Pass& pass) const {
    if (!description.barriers.empty()) wait();
    if (description.shader.empty()) {
        vkCmdFillBuffer(commands_, buffers_[description.uses[0].buffer].handle, 0, VK_WHOLE_SIZE, 0);
        return;
    }
    const VkPipelineBindPoint point = description.draws() ? VK_PIPELINE_BIND_POINT_GRAPHICS : VK_PIPELINE_BIND_POINT_COMPUTE;
    vkCmdBindPipeline(commands_, point, pass.pipeline);
    vkCmdBindDescriptorSets(commands_, point, pass.layout, 0, 1, &pass.set, 0, nullptr);
    if (description.draws()) return recordDraws(description, pass);
    vkCmdDispatch(commands_, description.groups.x, description.groups.y, description.groups.z);
}

void SmallExecutor::run(const std::string& name) {
    std::size_t s = 0;
    while (frame_.steps.at(s).name != name) ++s;
    begin();
    for (std::size_t p = 0; p < steps_[s].size(); ++p) record(frame_.steps[s].passes[p], steps_[s][p]);
    const VkMemoryBarrier toHost{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, VK_ACCESS_MEMORY_WRITE_BIT, VK_ACCESS_HOST_READ_BIT};
    vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &toHost, 0, nullptr, 0, nullptr);
    submit();
}

void SmallExecutor::begin() const {
    const VkCommandBufferBeginInfo once{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr, VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT, nullptr};
    check(vkBeginCommandBuffer(commands_, &once));
}

void SmallExecutor::submit() const {
    check(vkEndCommandBuffer(commands_));
    const VkSubmitInfo work{VK_STRUCTURE_TYPE_SUBMIT_INFO, nullptr, 0, nullptr, nullptr, 1, &commands_, 0, nullptr};
    check(vkQueueSubmit(queue_, 1, &work, VK_NULL_HANDLE));
    check(vkQueueWaitIdle(queue_));
}

// All that was recorded is over before what follows.
void SmallExecutor::wait() const {
    const VkAccessFlags all = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    const VkMemoryBarrier memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, all, all};
    vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 1, &memory, 0, nullptr, 0, nullptr);
}

void SmallExecutor::uploadBytes(const std::string& buffer, std::span<const std::byte> bytes) {
    if (bytes.size() > frame_.buffers.at(frame_.bufferIndex(buffer)).bytes) throw std::runtime_error(buffer + " is smaller");
    std::copy(bytes.begin(), bytes.end(), buffers_.at(frame_.bufferIndex(buffer)).mapped);
}

void SmallExecutor::downloadBytes(const std::string& buffer, std::span<std::byte> bytes) const {
    if (bytes.size() > frame_.buffers.at(frame_.bufferIndex(buffer)).bytes) throw std::runtime_error(buffer + " is smaller");
    std::copy_n(buffers_.at(frame_.bufferIndex(buffer)).mapped, bytes.size(), bytes.begin());
}

}  // namespace clv::test
