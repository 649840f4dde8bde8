#include "bindings/vulkan/vulkan_frame.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <stdexcept>

#include "bindings/vulkan/shader_interface.h"
#include "bindings/vulkan/vulkan_memory.h"

namespace clv {
namespace {

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
    bool hasRun = false;
};

// Where a buffer that the host cannot reach has its copy, and how much of that is newer than the buffer.
struct Staged {
    vk::DeviceSize offset = 0, newBytes = 0;
};

vk::DescriptorType descriptorType(FrameBinding binding) {
    switch (binding) {
        case FrameBinding::uniform: return vk::DescriptorType::eUniformBuffer;
        case FrameBinding::texel: return vk::DescriptorType::eUniformTexelBuffer;
        default: return vk::DescriptorType::eStorageBuffer;
    }
}

vk::BufferUsageFlags usageOf(FrameBinding binding) {
    switch (binding) {
        case FrameBinding::uniform: return vk::BufferUsageFlagBits::eUniformBuffer;
        case FrameBinding::texel: return vk::BufferUsageFlagBits::eUniformTexelBuffer;
        default: return vk::BufferUsageFlagBits::eStorageBuffer;
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

vk::PipelineStageFlags stageOf(const FramePass& pass) {
    return pass.shader.empty() ? vk::PipelineStageFlagBits::eTransfer : vk::PipelineStageFlagBits::eComputeShader;
}

// How the pass touches the buffer.
vk::AccessFlags accessTo(const FramePass& pass, std::uint32_t buffer) {
    if (pass.shader.empty()) return vk::AccessFlagBits::eTransferWrite;
    vk::AccessFlags flags;
    for (const FrameUse& use : pass.uses) {
        if (use.buffer != buffer) continue;
        if (frameReads(use.access)) flags |= use.binding == FrameBinding::uniform ? vk::AccessFlagBits::eUniformRead : vk::AccessFlagBits::eShaderRead;
        if (frameWrites(use.access)) flags |= vk::AccessFlagBits::eShaderWrite;
    }
    return flags;
}

// All that is done before, the host's part too, is over and visible to all that follows.
void orderAll(const vk::raii::CommandBuffer& commands) {
    const vk::AccessFlags all = vk::AccessFlagBits::eMemoryRead | vk::AccessFlagBits::eMemoryWrite;
    const vk::PipelineStageFlags stages = vk::PipelineStageFlagBits::eAllCommands | vk::PipelineStageFlagBits::eHost;
    commands.pipelineBarrier(stages, stages, {}, vk::MemoryBarrier(all, all), {}, {});
}

void throwFirst(const std::vector<std::string>& faults) {
    if (!faults.empty()) throw std::runtime_error("the frame cannot run: " + faults.front());
}

}  // namespace

struct VulkanFrame::Impl {
    VulkanDevice::Impl& device;
    const Frame frame;
    std::vector<VulkanBuffer> buffers;
    std::vector<Staged> uploads;                      // of each buffer
    VulkanBuffer uploadCopies, downloadCopy;          // in the host's memory
    vk::raii::DescriptorPool descriptors = nullptr;
    vk::raii::CommandPool commandPool = nullptr;
    vk::raii::CommandBuffer transfer = nullptr;
    vk::raii::Fence fence = nullptr;
    std::vector<Step> steps;
    std::vector<vk::CommandBuffer> submission;

    Impl(VulkanDevice::Impl& d, const Frame& f, ShaderLanguage language) : device(d), frame(f) {
        throwFirst(checkFrame(frame, device.info.limits));
        takeMemory();
        makeDescriptorPool();
        commandPool = vk::raii::CommandPool(device.device, {vk::CommandPoolCreateFlagBits::eResetCommandBuffer, device.queueFamily});
        transfer = makeCommands();
        fence = vk::raii::Fence(device.device, vk::FenceCreateInfo());
        for (const FrameStep& step : frame.steps) steps.push_back(makeStep(step, language));
        submission.reserve(steps.size() + 1);
        clearBuffers();
    }

    void takeMemory() {
        const auto copied = vk::BufferUsageFlagBits::eTransferDst | vk::BufferUsageFlagBits::eTransferSrc;
        std::vector<VulkanBufferWish> wishes;
        vk::DeviceSize hostBytes = 0, largestRead = 0;
        for (const FrameBuffer& buffer : frame.buffers) {
            VulkanBufferWish wish{buffer.bytes, copied};
            if (buffer.readBack) wish.use = VulkanMemoryUse::download, largestRead = std::max(largestRead, wish.bytes);
            uploads.push_back({hostBytes, 0});
            if (buffer.source == FrameSource::host) wish.use = VulkanMemoryUse::upload, hostBytes += wish.bytes;
            wishes.push_back(wish);
        }
        for (const FrameStep& step : frame.steps) {
            for (const FramePass& pass : step.passes) {
                for (const FrameUse& use : pass.uses) wishes[use.buffer].usage |= usageOf(use.binding);
            }
        }
        buffers = makeBuffers(device, wishes);
        bool copiesUp = false, copiesDown = false;
        for (std::size_t i = 0; i < buffers.size(); ++i) {
            if (buffers[i].mapped != nullptr) continue;
            copiesUp = copiesUp || frame.buffers[i].source == FrameSource::host;
            copiesDown = copiesDown || frame.buffers[i].readBack;
        }
        if (copiesUp) uploadCopies = makeHostCopy(hostBytes, VulkanMemoryUse::upload);
        if (copiesDown) downloadCopy = makeHostCopy(largestRead, VulkanMemoryUse::download);
    }

    VulkanBuffer makeHostCopy(vk::DeviceSize bytes, VulkanMemoryUse use) const {
        const VulkanBufferWish wish{bytes, vk::BufferUsageFlagBits::eTransferDst | vk::BufferUsageFlagBits::eTransferSrc, use, true};
        return std::move(makeBuffers(device, std::span(&wish, 1)).front());
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
        if (sets == 0) return;
        std::vector<vk::DescriptorPoolSize> sizes;
        for (const auto& [type, count] : counts) sizes.emplace_back(type, count);
        descriptors = vk::raii::DescriptorPool(device.device, {vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, sets, sizes});
    }

    vk::raii::CommandBuffer makeCommands() const {
        return std::move(vk::raii::CommandBuffers(device.device, {*commandPool, vk::CommandBufferLevel::ePrimary, 1}).front());
    }

    Pass makePass(const FramePass& pass, ShaderLanguage language) const {
        Pass made;
        if (pass.shader.empty()) return made;
        const auto words = shaderCode(pass.shader, language);
        throwFirst(shaderMismatches(frame, pass, shaderInterface(words), device.enabled));
        std::vector<vk::DescriptorSetLayoutBinding> bindings;
        for (const FrameUse& use : pass.uses) {
            bindings.emplace_back(frame.buffers[use.buffer].binding, descriptorType(use.binding), 1, vk::ShaderStageFlagBits::eCompute);
        }
        made.setLayout = vk::raii::DescriptorSetLayout(device.device, {{}, bindings});
        made.layout = vk::raii::PipelineLayout(device.device, {{}, *made.setLayout});
        made.pipeline = makePipeline(pass, words, *made.layout);
        made.set = std::move(vk::raii::DescriptorSets(device.device, {*descriptors, *made.setLayout}).front());
        for (const FrameUse& use : pass.uses) {
            const vk::Buffer buffer = *buffers[use.buffer].buffer;
            const vk::DescriptorBufferInfo whole(buffer, 0, VK_WHOLE_SIZE);
            vk::WriteDescriptorSet write(*made.set, frame.buffers[use.buffer].binding, 0, 1, descriptorType(use.binding), nullptr, &whole);
            if (use.binding == FrameBinding::texel) {
                made.views.emplace_back(device.device, vk::BufferViewCreateInfo({}, buffer, formatOf(use.format), 0, VK_WHOLE_SIZE));
                write.pTexelBufferView = &*made.views.back();
            }
            device.device.updateDescriptorSets(write, {});
        }
        return made;
    }

    vk::raii::Pipeline makePipeline(const FramePass& pass, std::span<const std::uint32_t> words, vk::PipelineLayout layout) const {
        const vk::raii::ShaderModule module(device.device, {{}, words.size_bytes(), words.data()});
        std::vector<vk::SpecializationMapEntry> entries;
        std::vector<std::uint32_t> values;
        for (const FrameConstant& constant : pass.constants) {
            entries.emplace_back(constant.id, std::uint32_t(values.size() * sizeof(std::uint32_t)), sizeof(std::uint32_t));
            values.push_back(constant.value);
        }
        const vk::SpecializationInfo specialisation(std::uint32_t(entries.size()), entries.data(), values.size() * sizeof(std::uint32_t), values.data());
        const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module, "main", &specialisation);
        return {device.device, nullptr, vk::ComputePipelineCreateInfo({}, stage, layout)};
    }

    Step makeStep(const FrameStep& description, ShaderLanguage language) const {
        Step step;
        for (const FramePass& pass : description.passes) step.passes.push_back(makePass(pass, language));
        const std::uint32_t stamps = std::uint32_t(description.passes.size() + 1);
        const bool timed = device.timestampPeriod > 0.0f;
        if (timed) step.timestamps = vk::raii::QueryPool(device.device, {{}, vk::QueryType::eTimestamp, stamps});
        step.commands = makeCommands();
        step.commands.begin({vk::CommandBufferUsageFlagBits::eSimultaneousUse});  // a submission may hold the step twice
        if (timed) step.commands.resetQueryPool(*step.timestamps, 0, stamps);
        orderAll(step.commands);
        if (timed) step.commands.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *step.timestamps, 0);
        for (std::size_t p = 0; p < description.passes.size(); ++p) {
            record(step, description, p);
            if (timed) step.commands.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *step.timestamps, std::uint32_t(p + 1));
        }
        orderAll(step.commands);
        step.commands.end();
        return step;
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

    void submitAndWait() {
        device.queue.submit(vk::SubmitInfo({}, {}, submission), *fence);
        try {
            if (device.device.waitForFences(*fence, true, UINT64_MAX) != vk::Result::eSuccess) throw std::runtime_error("Vulkan: the device does not answer");
        } catch (...) {
            // The work may still run, and what it uses must outlive it; a device that is truly lost says so again at once.
            try {
                device.device.waitIdle();
            } catch (const vk::SystemError&) {
            }
            throw;
        }
        device.device.resetFences(*fence);
    }

    template <class Record>
    void recordTransfer(Record&& recordCommands) {
        transfer.reset();
        transfer.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
        orderAll(transfer);
        recordCommands();
        orderAll(transfer);
        transfer.end();
        submission.push_back(*transfer);
    }

    bool hasNewUploads() const {
        return std::any_of(uploads.begin(), uploads.end(), [](const Staged& staged) { return staged.newBytes > 0; });
    }
    void copyUploads() {
        for (std::size_t i = 0; i < uploads.size(); ++i) {
            if (uploads[i].newBytes == 0) continue;
            transfer.copyBuffer(*uploadCopies.buffer, *buffers[i].buffer, vk::BufferCopy(uploads[i].offset, 0, uploads[i].newBytes));
            uploads[i].newBytes = 0;
        }
    }

    void clearBuffers() {
        recordTransfer([&] {
            for (std::size_t i = 0; i < buffers.size(); ++i) {
                if (frame.buffers[i].source == FrameSource::zero) transfer.fillBuffer(*buffers[i].buffer, 0, VK_WHOLE_SIZE, 0);
            }
        });
        submitAndWait();
    }

    std::size_t bufferOf(std::string_view name, std::size_t bytes) const {
        const std::uint32_t i = frame.bufferIndex(name);
        if (i == frame.buffers.size()) throw std::runtime_error("the frame has no buffer " + std::string(name));
        if (bytes > frame.buffers[i].bytes) throw std::runtime_error("buffer " + std::string(name) + " holds " + std::to_string(frame.buffers[i].bytes) + " bytes, not " + std::to_string(bytes));
        return i;
    }

    std::size_t stepOf(std::string_view name) const {
        for (std::size_t i = 0; i < steps.size(); ++i) {
            if (frame.steps[i].name == name) return i;
        }
        throw std::runtime_error("the frame has no step " + std::string(name));
    }
};

VulkanFrame::VulkanFrame(VulkanDevice& device, const Frame& frame, ShaderLanguage language)
    : impl_(inWords([&] { return std::make_unique<Impl>(device.impl(), frame, language); })) {}
VulkanFrame::~VulkanFrame() = default;

void VulkanFrame::uploadBytes(std::string_view buffer, std::span<const std::byte> bytes) {
    Impl& d = *impl_;
    const std::size_t i = d.bufferOf(buffer, bytes.size());
    if (d.frame.buffers[i].source != FrameSource::host) throw std::runtime_error("buffer " + std::string(buffer) + " is not the host's to fill");
    if (bytes.empty()) return;
    const bool direct = d.buffers[i].mapped != nullptr;
    std::memcpy(direct ? d.buffers[i].mapped : d.uploadCopies.mapped + d.uploads[i].offset, bytes.data(), bytes.size());
    if (!direct) d.uploads[i].newBytes = std::max<vk::DeviceSize>(d.uploads[i].newBytes, bytes.size());
}

void VulkanFrame::downloadBytes(std::string_view buffer, std::span<std::byte> bytes) {
    Impl& d = *impl_;
    const std::size_t i = d.bufferOf(buffer, bytes.size());
    if (!d.frame.buffers[i].readBack) throw std::runtime_error("buffer " + std::string(buffer) + " is not declared as one that the host reads back");
    if (bytes.empty()) return;
    const bool direct = d.buffers[i].mapped != nullptr;
    if (!direct) {
        inWords([&] {
            d.submission.clear();
            d.recordTransfer([&] { d.transfer.copyBuffer(*d.buffers[i].buffer, *d.downloadCopy.buffer, vk::BufferCopy(0, 0, bytes.size())); });
            d.submitAndWait();
        });
    }
    std::memcpy(bytes.data(), direct ? d.buffers[i].mapped : d.downloadCopy.mapped, bytes.size());
}

void VulkanFrame::runSteps(std::span<const std::string_view> names) {
    Impl& d = *impl_;
    for (const std::string_view name : names) d.stepOf(name);  // before anything happens
    inWords([&] {
        d.submission.clear();
        if (d.hasNewUploads()) d.recordTransfer([&] { d.copyUploads(); });
        for (const std::string_view name : names) d.submission.push_back(*d.steps[d.stepOf(name)].commands);
        d.submitAndWait();
        for (const std::string_view name : names) d.steps[d.stepOf(name)].hasRun = true;
    });
}

std::vector<std::pair<std::string, double>> VulkanFrame::times(std::string_view step) const {
    const std::size_t i = impl_->stepOf(step);
    const Step& made = impl_->steps[i];
    std::vector<std::pair<std::string, double>> times;
    if (!(impl_->device.timestampPeriod > 0.0f) || !made.hasRun) return times;
    const std::vector<FramePass>& passes = impl_->frame.steps[i].passes;
    const std::uint32_t count = std::uint32_t(passes.size() + 1);
    const auto [result, ticks] = inWords([&] {
        return made.timestamps.getResults<std::uint64_t>(0, count, count * sizeof(std::uint64_t), sizeof(std::uint64_t), vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
    });
    if (result != vk::Result::eSuccess) return times;
    for (std::size_t p = 0; p < passes.size(); ++p) {
        const std::uint64_t taken = (ticks[p + 1] - ticks[p]) & impl_->device.timestampMask;
        times.emplace_back(passes[p].name, 1e-6 * impl_->device.timestampPeriod * double(taken));
    }
    return times;
}

}  // namespace clv
