#include "vulkan/watched_vulkan.h"

#include <cstring>
#include <vector>

#define VK_NO_PROTOTYPES
#include <vulkan/vulkan.h>

namespace {

clv::test::WatchedVulkan watched;

PFN_vkVoidFunction real(VkInstance instance, const char* name) {
    static void* library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
    static const auto get = reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library, "vkGetInstanceProcAddr"));
    return get(instance, name);
}

// The system's function of each name; device functions among them, for the one device that a test has at a time.
std::map<std::string, PFN_vkVoidFunction> realFunctions;

template <class Function>
Function realAs(const char* name) {
    return reinterpret_cast<Function>(realFunctions.at(name));
}

// Counts a call of the function. Whether it is to fail.
bool fails(const std::string& name) { return ++watched.calls[name] > watched.failAfter && watched.failing == name; }

// Counts calls of a function that returns a VkResult, and lets it fail.
template <class Function, const char* name>
struct Watched;
template <class... Arguments, const char* name>
struct Watched<VkResult(VKAPI_PTR*)(Arguments...), name> {
    static VKAPI_ATTR VkResult VKAPI_CALL call(Arguments... arguments) {
        if (fails(name)) return VkResult(watched.failure);
        return realAs<VkResult(VKAPI_PTR*)(Arguments...)>(name)(arguments...);
    }
};

VKAPI_ATTR VkResult VKAPI_CALL allocateMemory(VkDevice device, const VkMemoryAllocateInfo* info, const VkAllocationCallbacks* callbacks, VkDeviceMemory* memory) {
    if (fails("vkAllocateMemory")) return VkResult(watched.failure);
    watched.bytesTaken += info->allocationSize;
    VkMemoryAllocateInfo one = *info;
    if (watched.separateMemory) one.memoryTypeIndex = 0;
    return realAs<PFN_vkAllocateMemory>("vkAllocateMemory")(device, &one, callbacks, memory);
}

VKAPI_ATTR VkResult VKAPI_CALL enumeratePhysicalDevices(VkInstance instance, std::uint32_t* count, VkPhysicalDevice* devices) {
    if (devices == nullptr || watched.devices == 0) {
        *count = std::uint32_t(watched.devices);
        return VK_SUCCESS;
    }
    std::uint32_t one = 1;
    realAs<PFN_vkEnumeratePhysicalDevices>("vkEnumeratePhysicalDevices")(instance, &one, devices);
    for (std::uint32_t i = 1; i < *count; ++i) devices[i] = devices[0];
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL enumerateDeviceExtensions(VkPhysicalDevice device, const char* layer, std::uint32_t* count, VkExtensionProperties* properties) {
    if (!watched.coreFeaturesOnly) return realAs<PFN_vkEnumerateDeviceExtensionProperties>("vkEnumerateDeviceExtensionProperties")(device, layer, count, properties);
    *count = 0;
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL getProperties(VkPhysicalDevice device, VkPhysicalDeviceProperties* properties) {
    realAs<PFN_vkGetPhysicalDeviceProperties>("vkGetPhysicalDeviceProperties")(device, properties);
    if (watched.oldDevices) properties->apiVersion = VK_API_VERSION_1_0;
    if (watched.discrete) properties->deviceType = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
}

VKAPI_ATTR void VKAPI_CALL getProperties2(VkPhysicalDevice device, VkPhysicalDeviceProperties2* properties) {
    realAs<PFN_vkGetPhysicalDeviceProperties2>("vkGetPhysicalDeviceProperties2")(device, properties);
    for (auto* next = static_cast<VkBaseOutStructure*>(properties->pNext); next != nullptr; next = next->pNext) {
        if (next->sType != VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES || !watched.coreFeaturesOnly) continue;
        reinterpret_cast<VkPhysicalDeviceSubgroupProperties*>(next)->supportedOperations = VK_SUBGROUP_FEATURE_BASIC_BIT;
    }
}

// The one kind of memory of a software device as two: the device's own, and the host's.
void separate(VkPhysicalDeviceMemoryProperties& memory) {
    for (std::uint32_t heap = 0; heap < memory.memoryHeapCount && watched.heapBytes > 0; ++heap) memory.memoryHeaps[heap].size = watched.heapBytes;
    if (!watched.separateMemory) return;
    const VkMemoryPropertyFlags all = memory.memoryTypes[0].propertyFlags;
    memory.memoryTypeCount = 2, memory.memoryHeapCount = 2;
    memory.memoryTypes[0] = {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0};
    memory.memoryTypes[1] = {all & ~VkMemoryPropertyFlags(VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT), 1};
    memory.memoryHeaps[1] = {memory.memoryHeaps[0].size, 0};
}

VKAPI_ATTR void VKAPI_CALL getMemoryProperties(VkPhysicalDevice device, VkPhysicalDeviceMemoryProperties* memory) {
    realAs<PFN_vkGetPhysicalDeviceMemoryProperties>("vkGetPhysicalDeviceMemoryProperties")(device, memory);
    separate(*memory);
}

VKAPI_ATTR void VKAPI_CALL getMemoryProperties2(VkPhysicalDevice device, VkPhysicalDeviceMemoryProperties2* memory) {
    realAs<PFN_vkGetPhysicalDeviceMemoryProperties2>("vkGetPhysicalDeviceMemoryProperties2")(device, memory);
    separate(memory->memoryProperties);
    for (auto* next = static_cast<VkBaseOutStructure*>(memory->pNext); next != nullptr; next = next->pNext) {
        if (next->sType != VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT) continue;
        auto& budget = *reinterpret_cast<VkPhysicalDeviceMemoryBudgetPropertiesEXT*>(next);
        for (std::uint32_t heap = 0; heap < memory->memoryProperties.memoryHeapCount; ++heap) {
            if (watched.heapBytes > 0 || heap > 0) budget.heapBudget[heap] = memory->memoryProperties.memoryHeaps[heap].size, budget.heapUsage[heap] = 0;
        }
    }
}

VKAPI_ATTR void VKAPI_CALL getBufferMemory(VkDevice device, VkBuffer buffer, VkMemoryRequirements* needs) {
    realAs<PFN_vkGetBufferMemoryRequirements>("vkGetBufferMemoryRequirements")(device, buffer, needs);
    if (watched.separateMemory) needs->memoryTypeBits = 3;
}

#define CLV_NAME(function) constexpr char k_##function[] = #function;
#define CLV_WATCH(function) {#function, reinterpret_cast<PFN_vkVoidFunction>(&Watched<PFN_##function, k_##function>::call)},
#define CLV_WATCHED_FUNCTIONS(X)                                                                                                                     \
    X(vkCreateInstance) X(vkCreateDevice) X(vkCreateBuffer) X(vkCreateBufferView) X(vkCreateShaderModule) X(vkCreateComputePipelines)                \
    X(vkCreateDescriptorSetLayout) X(vkCreatePipelineLayout) X(vkCreateDescriptorPool) X(vkCreateCommandPool) X(vkCreateFence) X(vkCreateQueryPool)  \
    X(vkAllocateDescriptorSets) X(vkAllocateCommandBuffers) X(vkMapMemory) X(vkQueueSubmit) X(vkWaitForFences)
CLV_WATCHED_FUNCTIONS(CLV_NAME)

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getDeviceProcAddr(VkDevice device, const char* name);

PFN_vkVoidFunction ownFunction(const std::string& name) {
    static const std::map<std::string, PFN_vkVoidFunction> own{
        CLV_WATCHED_FUNCTIONS(CLV_WATCH)
        {"vkAllocateMemory", reinterpret_cast<PFN_vkVoidFunction>(&allocateMemory)},
        {"vkEnumeratePhysicalDevices", reinterpret_cast<PFN_vkVoidFunction>(&enumeratePhysicalDevices)},
        {"vkEnumerateDeviceExtensionProperties", reinterpret_cast<PFN_vkVoidFunction>(&enumerateDeviceExtensions)},
        {"vkGetPhysicalDeviceProperties", reinterpret_cast<PFN_vkVoidFunction>(&getProperties)},
        {"vkGetPhysicalDeviceProperties2", reinterpret_cast<PFN_vkVoidFunction>(&getProperties2)},
        {"vkGetPhysicalDeviceMemoryProperties", reinterpret_cast<PFN_vkVoidFunction>(&getMemoryProperties)},
        {"vkGetPhysicalDeviceMemoryProperties2", reinterpret_cast<PFN_vkVoidFunction>(&getMemoryProperties2)},
        {"vkGetBufferMemoryRequirements", reinterpret_cast<PFN_vkVoidFunction>(&getBufferMemory)},
        {"vkGetDeviceProcAddr", reinterpret_cast<PFN_vkVoidFunction>(&getDeviceProcAddr)},
    };
    const auto found = own.find(name);
    return found == own.end() ? nullptr : found->second;
}

// `theirs`, or the function here that stands before it.
PFN_vkVoidFunction before(const char* name, PFN_vkVoidFunction theirs) {
    const PFN_vkVoidFunction own = ownFunction(name);
    if (own == nullptr || theirs == nullptr) return theirs;
    realFunctions[name] = theirs;
    return own;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getDeviceProcAddr(VkDevice device, const char* name) {
    return before(name, realAs<PFN_vkGetDeviceProcAddr>("vkGetDeviceProcAddr")(device, name));
}

}  // namespace

extern "C" __attribute__((visibility("default"))) clv::test::WatchedVulkan* clvWatchedVulkan() { return &watched; }
extern "C" __attribute__((visibility("default"))) PFN_vkVoidFunction vkGetInstanceProcAddr(VkInstance instance, const char* name) { return before(name, real(instance, name)); }
