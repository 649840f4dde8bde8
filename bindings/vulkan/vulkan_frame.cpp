#include "bindings/vulkan/vulkan_frame.h"

#include <cstring>
#include <map>
#include <stdexcept>

#include "bindings/vulkan/vulkan_device_impl.h"

namespace clv {
namespace {

struct Buffer {
    vk::raii::DeviceMemory memory = nullptr;
    vk::raii::Buffer buffer = nullptr;
    vk::DeviceSize bytes = 0;
};

struct Pass {
    vk::raii::DescriptorSetLayout setLayout = nullptr;
    vk::raii::PipelineLayout layout = nullptr;
    vk::raii::Pipeline pipeline = nullptr;
    std::vector<vk::raii::BufferView> views;
    vk::raii::DescriptorSet set = nullptr;
};

struct Step {
    std::vector<Pass> passes;
    vk::raii::CommandBuffer commands = nullptr;
    vk::raii::QueryPool timestamps = nullptr;
};

vk::DescriptorType descriptorType(FrameBinding binding) {
    switch (binding) {
        case FrameBinding::uniform: return vk::DescriptorType::eUniformBuffer;
        case FrameBinding::texel: return vk::DescriptorType::eUniformTexelBuffer;
        default: return vk::DescriptorType::eStorageBuffer;
    }
}

vk::Format formatOf(FrameFormat format) {
    switch (format) {
        case FrameFormat::rgba32Float: return vk::Format::eR32G32B32A32Sfloat;
        case FrameFormat::rgba32Uint: return vk::Format::eR32G32B32A32Uint;
        case FrameFormat::r32Float: return vk::Format::eR32Sfloat;
        default: return vk::Format::eUndefined;
    }
}

vk::AccessFlags accessOf(FrameAccess access) {
    vk::AccessFlags flags;
    if (frameReads(access)) flags |= vk::AccessFlagBits::eShaderRead;
    if (frameWrites(access)) flags |= vk::AccessFlagBits::eShaderWrite;
    return flags;
}

}  // namespace

struct VulkanFrame::Impl {
    VulkanDevice::Impl& device;
    const Frame frame;
    std::vector<Buffer> buffers;
    Buffer staging;
    vk::raii::DescriptorPool descriptors = nullptr;
    vk::raii::CommandPool commandPool = nullptr;
    vk::raii::CommandBuffer transfer = nullptr;
    vk::raii::Fence fence = nullptr;
    std::map<std::string, Step> steps;

    Impl(VulkanDevice::Impl& d, const Frame& f, ShaderLanguage language) : device(d), frame(f) {
        makeBuffers();
        makeDescriptorPool();
        commandPool = vk::raii::CommandPool(device.device, {vk::CommandPoolCreateFlagBits::eResetCommandBuffer, device.queueFamily});
        transfer = std::move(vk::raii::CommandBuffers(device.device, {*commandPool, vk::CommandBufferLevel::ePrimary, 1}).front());
        fence = vk::raii::Fence(device.device, vk::FenceCreateInfo());
        for (const FrameStep& step : frame.steps) makeStep(step, language);
        clearBuffers();
    }

    std::uint32_t memoryType(std::uint32_t allowed, vk::MemoryPropertyFlags wanted) const {
        const auto properties = device.physical.getMemoryProperties();
        for (std::uint32_t i = 0; i < properties.memoryTypeCount; ++i) {
            if ((allowed >> i & 1u) && (properties.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
        }
        throw std::runtime_error("Vulkan: the device has no memory of the kind that a buffer needs");
    }

    Buffer makeBuffer(vk::DeviceSize bytes, vk::BufferUsageFlags usage, vk::MemoryPropertyFlags properties) const {
        Buffer b;
        b.bytes = bytes;
        b.buffer = vk::raii::Buffer(device.device, {{}, bytes, usage, vk::SharingMode::eExclusive});
        const auto needs = b.buffer.getMemoryRequirements();
        b.memory = vk::raii::DeviceMemory(device.device, {needs.size, memoryType(needs.memoryTypeBits, properties)});
        b.buffer.bindMemory(*b.memory, 0);
        return b;
    }

    void makeBuffers() {
        vk::DeviceSize largest = 0;
        for (const FrameBuffer& buffer : frame.buffers) {
            vk::BufferUsageFlags usage = vk::BufferUsageFlagBits::eTransferDst | vk::BufferUsageFlagBits::eTransferSrc;
            for (const FrameStep& step : frame.steps) {
                for (const FramePass& pass : step.passes) {
                    for (const FrameUse& use : pass.uses) {
                        if (&frame.buffers[use.buffer] != &buffer) continue;
                        usage |= use.binding == FrameBinding::uniform ? vk::BufferUsageFlagBits::eUniformBuffer
                                 : use.binding == FrameBinding::texel ? vk::BufferUsageFlagBits::eUniformTexelBuffer
                                                                      : vk::BufferUsageFlagBits::eStorageBuffer;
                    }
                }
            }
            buffers.push_back(makeBuffer(buffer.bytes, usage, vk::MemoryPropertyFlagBits::eDeviceLocal));
            if (buffer.source == FrameSource::host || buffer.readBack) largest = std::max(largest, vk::DeviceSize(buffer.bytes));
        }
        staging = makeBuffer(std::max<vk::DeviceSize>(largest, 4), vk::BufferUsageFlagBits::eTransferSrc | vk::BufferUsageFlagBits::eTransferDst,
                             vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent);
    }

    void makeDescriptorPool() {
        std::map<vk::DescriptorType, std::uint32_t> counts;
        std::uint32_t sets = 0;
        for (const FrameStep& step : frame.steps) {
            for (const FramePass& pass : step.passes) {
                if (pass.shader.empty()) continue;
                ++sets;
                for (const FrameUse& use : pass.uses) ++counts[descriptorType(use.binding)];
            }
        }
        std::vector<vk::DescriptorPoolSize> sizes;
        for (const auto& [type, count] : counts) sizes.emplace_back(type, count);
        descriptors = vk::raii::DescriptorPool(device.device, {vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, sets, sizes});
    }

    Pass makePass(const FramePass& pass, ShaderLanguage language) {
        Pass made;
        std::vector<vk::DescriptorSetLayoutBinding> bindings;
        for (const FrameUse& use : pass.uses) {
            bindings.emplace_back(frame.buffers[use.buffer].binding, descriptorType(use.binding), 1, vk::ShaderStageFlagBits::eCompute);
        }
        made.setLayout = vk::raii::DescriptorSetLayout(device.device, {{}, bindings});
        made.layout = vk::raii::PipelineLayout(device.device, {{}, *made.setLayout});
        const auto words = shaderCode(pass.shader, language);
        const vk::raii::ShaderModule module(device.device, {{}, words.size_bytes(), words.data()});
        std::vector<vk::SpecializationMapEntry> entries;
        std::vector<std::uint32_t> values;
        for (const FrameConstant& constant : pass.constants) {
            entries.emplace_back(constant.id, std::uint32_t(values.size() * sizeof(std::uint32_t)), sizeof(std::uint32_t));
            values.push_back(constant.value);
        }
        const vk::SpecializationInfo specialisation(std::uint32_t(entries.size()), entries.data(), values.size() * sizeof(std::uint32_t), values.data());
        const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module, "main", &specialisation);
        made.pipeline = vk::raii::Pipeline(device.device, nullptr, vk::ComputePipelineCreateInfo({}, stage, *made.layout));
        made.set = std::move(vk::raii::DescriptorSets(device.device, {*descriptors, *made.setLayout}).front());
        for (const FrameUse& use : pass.uses) {
            const Buffer& buffer = buffers[use.buffer];
            const vk::DescriptorBufferInfo whole(*buffer.buffer, 0, VK_WHOLE_SIZE);
            vk::WriteDescriptorSet write(*made.set, frame.buffers[use.buffer].binding, 0, 1, descriptorType(use.binding));
            if (use.binding == FrameBinding::texel) {
                made.views.emplace_back(device.device, vk::BufferViewCreateInfo({}, *buffer.buffer, formatOf(use.format), 0, VK_WHOLE_SIZE));
                write.pTexelBufferView = &*made.views.back();
                device.device.updateDescriptorSets(write, {});
            } else {
                write.pBufferInfo = &whole;
                device.device.updateDescriptorSets(write, {});
            }
        }
        return made;
    }

    void makeStep(const FrameStep& description, ShaderLanguage language) {
        Step& step = steps[description.name];
        for (const FramePass& pass : description.passes) step.passes.push_back(pass.shader.empty() ? Pass() : makePass(pass, language));
        const std::uint32_t stamps = std::uint32_t(description.passes.size() + 1);
        const bool timed = device.timestampPeriod > 0.0f;
        if (timed) step.timestamps = vk::raii::QueryPool(device.device, {{}, vk::QueryType::eTimestamp, stamps});
        step.commands = std::move(vk::raii::CommandBuffers(device.device, {*commandPool, vk::CommandBufferLevel::ePrimary, 1}).front());
        step.commands.begin(vk::CommandBufferBeginInfo());
        if (timed) step.commands.resetQueryPool(*step.timestamps, 0, stamps);
        orderAfterEverything(step.commands);
        if (timed) step.commands.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *step.timestamps, 0);
        for (std::size_t p = 0; p < description.passes.size(); ++p) {
            record(step, description, p);
            if (timed) step.commands.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *step.timestamps, std::uint32_t(p + 1));
        }
        orderAfterEverything(step.commands);
        step.commands.end();
    }

    static void orderAfterEverything(const vk::raii::CommandBuffer& commands) {
        const auto all = vk::AccessFlagBits::eMemoryRead | vk::AccessFlagBits::eMemoryWrite;
        commands.pipelineBarrier(vk::PipelineStageFlagBits::eAllCommands, vk::PipelineStageFlagBits::eAllCommands, {}, vk::MemoryBarrier(all, all), {}, {});
    }

    static vk::PipelineStageFlags stageOf(const FramePass& pass) {
        return pass.shader.empty() ? vk::PipelineStageFlagBits::eTransfer : vk::PipelineStageFlagBits::eComputeShader;
    }
    static vk::AccessFlags accessTo(const FramePass& pass, std::uint32_t buffer) {
        if (pass.shader.empty()) return vk::AccessFlagBits::eTransferWrite;
        vk::AccessFlags flags;
        for (const FrameUse& use : pass.uses) {
            if (use.buffer != buffer) continue;
            flags |= use.binding == FrameBinding::uniform ? vk::AccessFlags(vk::AccessFlagBits::eUniformRead) : accessOf(use.access);
        }
        return flags;
    }

    void record(const Step& step, const FrameStep& description, std::size_t p) const {
        const FramePass& pass = description.passes[p];
        for (const FrameBarrier& barrier : pass.barriers) {
            const FramePass& earlier = description.passes[barrier.after];
            const vk::BufferMemoryBarrier memory(accessTo(earlier, barrier.buffer), accessTo(pass, barrier.buffer), VK_QUEUE_FAMILY_IGNORED,
                                                 VK_QUEUE_FAMILY_IGNORED, *buffers[barrier.buffer].buffer, 0, VK_WHOLE_SIZE);
            step.commands.pipelineBarrier(stageOf(earlier), stageOf(pass), {}, {}, memory, {});
        }
        if (pass.shader.empty()) {
            step.commands.fillBuffer(*buffers[pass.uses[0].buffer].buffer, 0, VK_WHOLE_SIZE, 0);
            return;
        }
        step.commands.bindPipeline(vk::PipelineBindPoint::eCompute, *step.passes[p].pipeline);
        step.commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *step.passes[p].layout, 0, *step.passes[p].set, {});
        step.commands.dispatch(pass.groups.x, pass.groups.y, pass.groups.z);
    }

    void submit(const vk::raii::CommandBuffer& commands) const {
        const vk::CommandBuffer handle = *commands;
        device.queue.submit(vk::SubmitInfo({}, {}, handle), *fence);
        if (device.device.waitForFences(*fence, true, UINT64_MAX) != vk::Result::eSuccess) throw std::runtime_error("Vulkan: the device does not answer");
        device.device.resetFences(*fence);
    }

    template <class Record>
    void transferNow(Record&& recordCommands) const {
        transfer.reset();
        transfer.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
        orderAfterEverything(transfer);
        recordCommands(transfer);
        orderAfterEverything(transfer);
        transfer.end();
        submit(transfer);
    }

    void clearBuffers() {
        transferNow([&](const vk::raii::CommandBuffer& commands) {
            for (std::size_t i = 0; i < buffers.size(); ++i) {
                if (frame.buffers[i].source == FrameSource::zero) commands.fillBuffer(*buffers[i].buffer, 0, VK_WHOLE_SIZE, 0);
            }
        });
    }

    std::uint32_t find(const std::string& name, std::size_t bytes) const {
        const std::uint32_t i = frame.bufferIndex(name);
        if (i == frame.buffers.size()) throw std::runtime_error("the frame has no buffer " + name);
        if (bytes > frame.buffers[i].bytes) throw std::runtime_error("buffer " + name + " holds " + std::to_string(frame.buffers[i].bytes) + " bytes, not " + std::to_string(bytes));
        return i;
    }
};

VulkanFrame::VulkanFrame(VulkanDevice& device, const Frame& frame, ShaderLanguage language)
try : impl_(std::make_unique<Impl>(device.impl(), frame, language)) {
} catch (const vk::SystemError& error) {
    throw std::runtime_error(std::string("Vulkan: ") + error.what());
}

VulkanFrame::~VulkanFrame() = default;

void VulkanFrame::uploadBytes(const std::string& buffer, std::span<const std::byte> bytes) {
    const std::uint32_t i = impl_->find(buffer, bytes.size());
    if (impl_->frame.buffers[i].source != FrameSource::host) throw std::runtime_error("buffer " + buffer + " is not the host's to fill");
    if (bytes.empty()) return;
    void* mapped = impl_->staging.memory.mapMemory(0, bytes.size());
    std::memcpy(mapped, bytes.data(), bytes.size());
    impl_->staging.memory.unmapMemory();
    impl_->transferNow([&](const vk::raii::CommandBuffer& commands) {
        commands.copyBuffer(*impl_->staging.buffer, *impl_->buffers[i].buffer, vk::BufferCopy(0, 0, bytes.size()));
    });
}

void VulkanFrame::downloadBytes(const std::string& buffer, std::span<std::byte> bytes) const {
    const std::uint32_t i = impl_->find(buffer, bytes.size());
    if (!impl_->frame.buffers[i].readBack) throw std::runtime_error("buffer " + buffer + " is not declared as one that the host reads back");
    if (bytes.empty()) return;
    impl_->transferNow([&](const vk::raii::CommandBuffer& commands) {
        commands.copyBuffer(*impl_->buffers[i].buffer, *impl_->staging.buffer, vk::BufferCopy(0, 0, bytes.size()));
    });
    const void* mapped = impl_->staging.memory.mapMemory(0, bytes.size());
    std::memcpy(bytes.data(), mapped, bytes.size());
    impl_->staging.memory.unmapMemory();
}

void VulkanFrame::run(const std::string& step) {
    const auto found = impl_->steps.find(step);
    if (found == impl_->steps.end()) throw std::runtime_error("the frame has no step " + step);
    impl_->submit(found->second.commands);
}

std::vector<std::pair<std::string, double>> VulkanFrame::times(const std::string& step) const {
    std::vector<std::pair<std::string, double>> times;
    if (!(impl_->device.timestampPeriod > 0.0f)) return times;
    for (const FrameStep& description : impl_->frame.steps) {
        if (description.name != step) continue;
        const std::size_t count = description.passes.size() + 1;
        const auto [result, ticks] = impl_->steps.at(step).timestamps.getResults<std::uint64_t>(
            0, std::uint32_t(count), count * sizeof(std::uint64_t), sizeof(std::uint64_t), vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
        if (result != vk::Result::eSuccess) return times;
        for (std::size_t p = 0; p + 1 < count; ++p) {
            times.emplace_back(description.passes[p].name, 1e-6 * impl_->device.timestampPeriod * double(ticks[p + 1] - ticks[p]));
        }
    }
    return times;
}

}  // namespace clv
