#include "bindings/vulkan/vulkan_memory.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "bindings/vulkan/vulkan_words.h"

namespace clv {
namespace {

using Property = vk::MemoryPropertyFlagBits;

// Memory that the host writes in whole lines and reads slowly, and memory that it reads fast.
constexpr vk::MemoryPropertyFlags kHostWrites = Property::eHostVisible | Property::eHostCoherent;
constexpr vk::MemoryPropertyFlags kHostReads = kHostWrites | Property::eHostCached;

class MemoryKinds {
public:
    explicit MemoryKinds(const vk::raii::PhysicalDevice& device) : memory_(device.getMemoryProperties()) {
        for (std::uint32_t heap = 0; heap < memory_.memoryHeapCount; ++heap) {
            const bool local(memory_.memoryHeaps[heap].flags & vk::MemoryHeapFlagBits::eDeviceLocal);
            if (local) largestLocal_ = std::max(largestLocal_, memory_.memoryHeaps[heap].size);
        }
    }

    std::uint32_t heapOf(std::uint32_t type) const { return memory_.memoryTypes[type].heapIndex; }
    bool isMappable(std::uint32_t type) const { return (memory_.memoryTypes[type].propertyFlags & kHostWrites) == kHostWrites; }

    std::uint32_t choose(const VulkanBufferWish& wish, std::uint32_t allowed) const {
        const vk::MemoryPropertyFlags forHost = wish.use == VulkanMemoryUse::download ? kHostReads : kHostWrites;
        std::optional<std::uint32_t> type;
        if (wish.onHost) {
            type = find(allowed, forHost, false);
            if (!type) type = find(allowed, kHostWrites, false);
        } else {
            // A small window into the device's memory, as cards without a resizable one have, is left to others.
            if (wish.use != VulkanMemoryUse::device) type = find(allowed, forHost | Property::eDeviceLocal, true);
            if (!type) type = find(allowed, Property::eDeviceLocal, false);
        }
        if (!type) throw std::runtime_error("Vulkan: the device has no memory of the kind that a buffer needs");
        return *type;
    }

private:
    std::optional<std::uint32_t> find(std::uint32_t allowed, vk::MemoryPropertyFlags wanted, bool inLargestHeap) const {
        for (std::uint32_t type = 0; type < memory_.memoryTypeCount; ++type) {
            const bool fits = (memory_.memoryTypes[type].propertyFlags & wanted) == wanted && (allowed >> type & 1u);
            if (fits && (!inLargestHeap || memory_.memoryHeaps[heapOf(type)].size >= largestLocal_)) return type;
        }
        return {};
    }

    vk::PhysicalDeviceMemoryProperties memory_;
    vk::DeviceSize largestLocal_ = 0;
};

// Bytes of each heap that are free, as far as the driver says.
std::vector<vk::DeviceSize> freeBytes(const VulkanDevice::Impl& device) {
    std::vector<vk::DeviceSize> free;
    if (!device.statesBudget) {
        const auto memory = device.physical.getMemoryProperties();
        for (std::uint32_t heap = 0; heap < memory.memoryHeapCount; ++heap) free.push_back(memory.memoryHeaps[heap].size);
        return free;
    }
    const auto chain = device.physical.getMemoryProperties2<vk::PhysicalDeviceMemoryProperties2, vk::PhysicalDeviceMemoryBudgetPropertiesEXT>();
    const auto& budget = chain.get<vk::PhysicalDeviceMemoryBudgetPropertiesEXT>();
    const std::uint32_t heaps = chain.get<vk::PhysicalDeviceMemoryProperties2>().memoryProperties.memoryHeapCount;
    for (std::uint32_t heap = 0; heap < heaps; ++heap) free.push_back(budget.heapBudget[heap] - std::min(budget.heapBudget[heap], budget.heapUsage[heap]));
    return free;
}

vk::raii::Image makeImage(const VulkanDevice::Impl& device, const VulkanBufferWish& wish) {
    const FrameImage& image = wish.image;
    const bool isVolume = image.shape == FrameShape::volume;
    vk::ImageCreateInfo info;
    // Slices of a volume are drawn into as layers are.
    if (isVolume) info.flags = vk::ImageCreateFlagBits::e2DArrayCompatible;
    info.imageType = isVolume ? vk::ImageType::e3D : vk::ImageType::e2D;
    info.format = vulkanFormat(image.format);
    info.extent = vk::Extent3D(image.extent.x, image.extent.y, isVolume ? image.extent.z : 1);
    info.mipLevels = 1;
    info.arrayLayers = isVolume ? 1 : image.extent.z;
    info.usage = wish.imageUsage;
    return {device.device, info};
}

std::string mebibytes(vk::DeviceSize bytes) { return std::to_string((bytes >> 20) + (bytes % (1 << 20) != 0)) + " MiB"; }

}  // namespace

std::vector<VulkanBuffer> makeBuffers(const VulkanDevice::Impl& device, std::span<const VulkanBufferWish> wishes) {
    const MemoryKinds kinds(device.physical);
    const std::vector<vk::DeviceSize> free = freeBytes(device);
    std::vector<vk::DeviceSize> needed(free.size());
    std::vector<VulkanBuffer> buffers(wishes.size());
    std::vector<vk::MemoryAllocateInfo> allocations;
    for (std::size_t i = 0; i < wishes.size(); ++i) {
        const bool isImage = wishes[i].image.format != FrameFormat::none;
        const auto owner = buffers[i].owner = std::make_shared<VulkanBuffer::Memory>();
        if (isImage) {
            owner->image = makeImage(device, wishes[i]);
            buffers[i].image = *owner->image;
        } else {
            owner->buffer = vk::raii::Buffer(device.device, {{}, wishes[i].bytes, wishes[i].usage, vk::SharingMode::eExclusive});
            buffers[i].buffer = *owner->buffer;
        }
        const vk::MemoryRequirements needs = isImage ? owner->image.getMemoryRequirements() : owner->buffer.getMemoryRequirements();
        allocations.emplace_back(needs.size, kinds.choose(wishes[i], needs.memoryTypeBits));
        needed[kinds.heapOf(allocations[i].memoryTypeIndex)] += needs.size;
    }
    for (std::size_t heap = 0; heap < free.size(); ++heap) {
        if (needed[heap] > free[heap]) throw std::runtime_error("Vulkan: the frame takes " + mebibytes(needed[heap]) + " of memory, of which " + device.info.name + " has " + mebibytes(free[heap]) + " free");
    }
    for (std::size_t i = 0; i < wishes.size(); ++i) {
        VulkanBuffer::Memory& owner = *buffers[i].owner;
        const vk::MemoryAllocateFlagsInfo addressed(vk::MemoryAllocateFlagBits::eDeviceAddress);
        if (wishes[i].usage & vk::BufferUsageFlagBits::eShaderDeviceAddress) allocations[i].pNext = &addressed;
        owner.memory = vk::raii::DeviceMemory(device.device, allocations[i]);
        if (buffers[i].image) {
            owner.image.bindMemory(*owner.memory, 0);
            continue;
        }
        owner.buffer.bindMemory(*owner.memory, 0);
        const bool mappable = wishes[i].use != VulkanMemoryUse::device && kinds.isMappable(allocations[i].memoryTypeIndex);
        if (mappable) buffers[i].mapped = static_cast<std::byte*>(owner.memory.mapMemory(0, VK_WHOLE_SIZE));
    }
    return buffers;
}

}  // namespace clv
