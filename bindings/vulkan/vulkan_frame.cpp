#include "bindings/vulkan/vulkan_frame.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "bindings/vulkan/vulkan_pass.h"
#include "bindings/vulkan/vulkan_words.h"

namespace clv {
namespace {

// All that is done before, the host's part too, is over and visible to all that follows.
void orderAll(const vk::raii::CommandBuffer& commands) {
    const vk::AccessFlags all = vk::AccessFlagBits::eMemoryRead | vk::AccessFlagBits::eMemoryWrite;
    const vk::PipelineStageFlags stages = vk::PipelineStageFlagBits::eAllCommands | vk::PipelineStageFlagBits::eHost;
    commands.pipelineBarrier(stages, stages, {}, vk::MemoryBarrier(all, all), {}, {});
}

}  // namespace

struct VulkanFrame::Impl {
    struct Step {
        std::vector<VulkanPass> passes;
        vk::raii::CommandBuffer commands = nullptr;
        vk::raii::QueryPool timestamps = nullptr;
        bool hasRun = false;
    };

    // Where a buffer that the host cannot reach has its copy, and how much of that is newer than the buffer.
    struct Staged {
        vk::DeviceSize offset = 0, newBytes = 0;
    };

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

    Impl(VulkanDevice::Impl& d, const Frame& f, ShaderLanguage language, const Impl* lender) : device(d), frame(f) {
        throwFirst(checkFrame(frame, device.info.limits));
        takeMemory(lender);
        descriptors = makeDescriptorPool(device, frame);
        commandPool = vk::raii::CommandPool(device.device, {vk::CommandPoolCreateFlagBits::eResetCommandBuffer, device.queueFamily});
        transfer = makeCommands();
        fence = vk::raii::Fence(device.device, vk::FenceCreateInfo());
        for (const FrameStep& step : frame.steps) steps.push_back(makeStep(step, language));
        submission.reserve(steps.size() + 1);
        fillBuffers();
    }

    void takeMemory(const Impl* lender) {
        const auto copied = vk::BufferUsageFlagBits::eTransferDst | vk::BufferUsageFlagBits::eTransferSrc;
        const auto copiedImage = vk::ImageUsageFlagBits::eTransferDst | vk::ImageUsageFlagBits::eTransferSrc;
        std::vector<VulkanBufferWish> wishes;
        vk::DeviceSize hostBytes = 0, largestRead = 0;
        for (const FrameBuffer& buffer : frame.buffers) {
            if (buffer.isAcceleration()) requireRayTracing(device);
            VulkanBufferWish wish{.bytes = buffer.bytes, .usage = copied, .image = buffer.image, .imageUsage = copiedImage};
            if (buffer.readBack) wish.use = VulkanMemoryUse::download, largestRead = std::max(largestRead, wish.bytes);
            uploads.push_back({hostBytes, 0});
            if (buffer.source == FrameSource::host) wish.use = VulkanMemoryUse::upload, hostBytes += wish.bytes;
            wishes.push_back(wish);
        }
        for (const FrameStep& step : frame.steps) {
            for (const FramePass& pass : step.passes) {
                for (const FrameUse& use : pass.uses) {
                    const FrameBuffer& buffer = frame.buffers[use.buffer];
                    buffer.isImage() ? void(wishes[use.buffer].imageUsage |= imageUsage(buffer.image, use.binding)) : void(wishes[use.buffer].usage |= bufferUsage(use.binding));
                }
            }
        }
        std::vector<VulkanBufferWish> own;
        for (std::size_t i = 0; i < wishes.size(); ++i) {
            if (frame.buffers[i].source != FrameSource::shared) own.push_back(wishes[i]);
        }
        const std::vector<VulkanBuffer> made = makeBuffers(device, own);
        for (auto next = made.begin(); const FrameBuffer& buffer : frame.buffers) {
            buffers.push_back(buffer.source == FrameSource::shared ? lentBuffer(lender, buffer) : *next++);
            const bool built = buffer.isAcceleration() && buffer.source != FrameSource::shared;
            if (built) buffers.back().owner->acceleration = makeAcceleration(device, buffer.triangles, buffers.back().buffer, buffer.bytes);
        }
        bool copiesUp = false, copiesDown = false;
        for (std::size_t i = 0; i < buffers.size(); ++i) {
            if (buffers[i].mapped != nullptr) continue;
            copiesUp = copiesUp || frame.buffers[i].source == FrameSource::host;
            copiesDown = copiesDown || frame.buffers[i].readBack;
        }
        if (copiesUp) uploadCopies = makeHostCopy(hostBytes, VulkanMemoryUse::upload);
        if (copiesDown) downloadCopy = makeHostCopy(largestRead, VulkanMemoryUse::download);
    }

    static const VulkanBuffer& lentBuffer(const Impl* lender, const FrameBuffer& wanted) {
        const std::size_t i = lender != nullptr ? lender->frame.bufferIndex(wanted.name) : 0;
        const bool lent = lender != nullptr && i < lender->buffers.size() && lender->frame.buffers[i].bytes >= wanted.bytes;
        if (!lent) throw std::runtime_error("no frame lends " + std::to_string(wanted.bytes) + " bytes of buffer " + wanted.name);
        return lender->buffers[i];
    }

    VulkanBuffer makeHostCopy(vk::DeviceSize bytes, VulkanMemoryUse use) const {
        const VulkanBufferWish wish{.bytes = bytes, .usage = vk::BufferUsageFlagBits::eTransferDst | vk::BufferUsageFlagBits::eTransferSrc, .use = use, .onHost = true};
        return std::move(makeBuffers(device, std::span(&wish, 1)).front());
    }

    vk::raii::CommandBuffer makeCommands() const {
        return std::move(vk::raii::CommandBuffers(device.device, {*commandPool, vk::CommandBufferLevel::ePrimary, 1}).front());
    }

    Step makeStep(const FrameStep& description, ShaderLanguage language) const {
        Step step;
        for (const FramePass& pass : description.passes) step.passes.push_back(makePass(device, frame, pass, buffers, descriptors, language));
        const std::uint32_t stamps = std::uint32_t(description.passes.size() + 1);
        const bool timed = device.timestampPeriod > 0.0f;
        if (timed) step.timestamps = vk::raii::QueryPool(device.device, {{}, vk::QueryType::eTimestamp, stamps});
        step.commands = makeCommands();
        step.commands.begin({vk::CommandBufferUsageFlagBits::eSimultaneousUse});  // a submission may hold the step twice
        if (timed) step.commands.resetQueryPool(*step.timestamps, 0, stamps);
        orderAll(step.commands);
        if (timed) step.commands.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *step.timestamps, 0);
        for (std::size_t p = 0; p < description.passes.size(); ++p) {
            recordPass(device, step.commands, frame, description, p, step.passes[p], buffers);
            if (timed) step.commands.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *step.timestamps, std::uint32_t(p + 1));
        }
        orderAll(step.commands);
        step.commands.end();
        return step;
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
            transfer.copyBuffer(uploadCopies.buffer, buffers[i].buffer, vk::BufferCopy(uploads[i].offset, 0, uploads[i].newBytes));
            uploads[i].newBytes = 0;
        }
    }

    // From one layout to another; images stay in the general one, which allows everything, but for copies.
    void changeLayout(std::size_t i, vk::ImageLayout from, vk::ImageLayout to) {
        const vk::AccessFlags all = vk::AccessFlagBits::eMemoryRead | vk::AccessFlagBits::eMemoryWrite;
        vk::ImageMemoryBarrier barrier(all, all, from, to, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, buffers[i].image);
        barrier.setSubresourceRange({imageAspect(frame.buffers[i].image), 0, 1, 0, VK_REMAINING_ARRAY_LAYERS});
        transfer.pipelineBarrier(vk::PipelineStageFlagBits::eAllCommands, vk::PipelineStageFlagBits::eAllCommands, {}, {}, {}, barrier);
    }

    // The start of a buffer or image to where the host reads it.
    void copyDown(std::size_t i, std::size_t bytes) {
        if (!frame.buffers[i].isImage()) return transfer.copyBuffer(buffers[i].buffer, downloadCopy.buffer, vk::BufferCopy(0, 0, bytes));
        const FrameImage& image = frame.buffers[i].image;
        const bool isVolume = image.shape == FrameShape::volume;
        const vk::ImageSubresourceLayers layers(imageAspect(image), 0, 0, isVolume ? 1 : image.extent.z);
        const vk::Extent3D extent(image.extent.x, image.extent.y, isVolume ? image.extent.z : 1);
        changeLayout(i, vk::ImageLayout::eGeneral, vk::ImageLayout::eTransferSrcOptimal);
        transfer.copyImageToBuffer(buffers[i].image, vk::ImageLayout::eTransferSrcOptimal, downloadCopy.buffer, vk::BufferImageCopy(0, 0, 0, layers, {}, extent));
        changeLayout(i, vk::ImageLayout::eTransferSrcOptimal, vk::ImageLayout::eGeneral);
    }

    // What passes find before the first run.
    void fillBuffers() {
        recordTransfer([&] {
            for (std::size_t i = 0; i < buffers.size(); ++i) {
                if (frame.buffers[i].isImage()) changeLayout(i, vk::ImageLayout::eUndefined, vk::ImageLayout::eGeneral);
            }
            for (std::size_t i = 0; i < buffers.size(); ++i) {
                if (frame.buffers[i].source == FrameSource::zero) recordClear(transfer, frame.buffers[i], buffers[i]);
            }
            for (const Step& step : steps) {
                for (const VulkanPass& pass : step.passes) recordShaderTable(transfer, pass.rays);
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

VulkanFrame::VulkanFrame(VulkanDevice& device, const Frame& frame, ShaderLanguage language, const VulkanFrame* lender)
    : impl_(inWords([&] { return std::make_unique<Impl>(device.impl(), frame, language, lender != nullptr ? lender->impl_.get() : nullptr); })) {}
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
            d.recordTransfer([&] { d.copyDown(i, bytes.size()); });
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
    const Impl::Step& made = impl_->steps[i];
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
