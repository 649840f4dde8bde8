#include "bindings/vulkan/vulkan_device.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "bindings/vulkan/vulkan_acceleration.h"
#include "bindings/vulkan/vulkan_device_impl.h"
#include "bindings/vulkan/vulkan_rays.h"
#include "bindings/vulkan/vulkan_words.h"

namespace clv {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                         const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    auto& impl = *static_cast<VulkanDevice::Impl*>(user);
    const std::lock_guard lock(impl.messageMutex);
    impl.messages.emplace_back(data->pMessage);
    return VK_FALSE;
}

vk::raii::Instance makeInstance(const vk::raii::Context& context, bool validate) {
    const vk::ApplicationInfo application("clv", 1, "clv", 1, VK_API_VERSION_1_1);
    std::vector<const char*> layers, extensions;
    if (validate) {
        const auto known = context.enumerateInstanceLayerProperties();
        const bool found = std::any_of(known.begin(), known.end(), [](const auto& layer) { return std::string(layer.layerName.data()) == kValidationLayer; });
        if (!found) throw std::runtime_error(std::string("Vulkan: the layer ") + kValidationLayer + " is not installed");
        layers.push_back(kValidationLayer);
        extensions = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
    }
    const vk::ValidationFeatureEnableEXT synchronisation = vk::ValidationFeatureEnableEXT::eSynchronizationValidation;
    const vk::ValidationFeaturesEXT features(synchronisation);
    return {context, vk::InstanceCreateInfo({}, &application, layers, extensions, validate ? &features : nullptr)};
}

std::string typeName(vk::PhysicalDeviceType type) {
    switch (type) {
        case vk::PhysicalDeviceType::eDiscreteGpu: return "discrete";
        case vk::PhysicalDeviceType::eIntegratedGpu: return "integrated";
        case vk::PhysicalDeviceType::eVirtualGpu: return "virtual";
        case vk::PhysicalDeviceType::eCpu: return "cpu";
        default: return "other";
    }
}

bool hasExtension(const vk::raii::PhysicalDevice& device, const char* name) {
    const auto extensions = device.enumerateDeviceExtensionProperties();
    return std::any_of(extensions.begin(), extensions.end(), [&](const auto& e) { return std::string(e.extensionName.data()) == name; });
}

// The first queue family that computes, and draws where one does both; -1 where none computes.
int queueFamilyOf(const vk::raii::PhysicalDevice& device) {
    const auto families = device.getQueueFamilyProperties();
    int family = -1;
    for (std::size_t i = families.size(); i-- > 0;) {
        const bool computes(families[i].queueFlags & vk::QueueFlagBits::eCompute), draws(families[i].queueFlags & vk::QueueFlagBits::eGraphics);
        const bool drawsAlready = family >= 0 && (families[std::size_t(family)].queueFlags & vk::QueueFlagBits::eGraphics);
        if (computes && (draws || !drawsAlready)) family = int(i);
    }
    return family;
}

// Where the device draws lines by the diamond-exit rule if it is asked to.
bool hasDiamondLines(const vk::raii::PhysicalDevice& device) {
    if (!hasExtension(device, VK_EXT_LINE_RASTERIZATION_EXTENSION_NAME)) return false;
    const auto chain = device.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceLineRasterizationFeaturesEXT>();
    return chain.get<vk::PhysicalDeviceLineRasterizationFeaturesEXT>().bresenhamLines;
}

// Acceleration structures, and what Vulkan 1.1 lacks for them and for shaders that search them.
constexpr const char* kAccelerationExtensions[] = {
    VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME, VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME, VK_KHR_BUFFER_DEVICE_ADDRESS_EXTENSION_NAME,
    VK_EXT_DESCRIPTOR_INDEXING_EXTENSION_NAME,    VK_KHR_SPIRV_1_4_EXTENSION_NAME,                VK_KHR_SHADER_FLOAT_CONTROLS_EXTENSION_NAME};

bool hasAccelerations(const vk::raii::PhysicalDevice& device) {
    if (!std::ranges::all_of(kAccelerationExtensions, [&](const char* name) { return hasExtension(device, name); })) return false;
    const auto chain = device.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceAccelerationStructureFeaturesKHR, vk::PhysicalDeviceBufferDeviceAddressFeatures>();
    return chain.get<vk::PhysicalDeviceAccelerationStructureFeaturesKHR>().accelerationStructure && chain.get<vk::PhysicalDeviceBufferDeviceAddressFeatures>().bufferDeviceAddress;
}

bool hasRayQueries(const vk::raii::PhysicalDevice& device) {
    if (!hasAccelerations(device) || !hasExtension(device, VK_KHR_RAY_QUERY_EXTENSION_NAME)) return false;
    return device.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceRayQueryFeaturesKHR>().get<vk::PhysicalDeviceRayQueryFeaturesKHR>().rayQuery;
}

bool hasRayPipelines(const vk::raii::PhysicalDevice& device) {
    if (!hasAccelerations(device) || !hasExtension(device, VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME)) return false;
    return device.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceRayTracingPipelineFeaturesKHR>().get<vk::PhysicalDeviceRayTracingPipelineFeaturesKHR>().rayTracingPipeline;
}

VulkanFeatures featuresOf(const vk::raii::PhysicalDevice& device) {
    VulkanFeatures features;
    const int family = queueFamilyOf(device);
    features.draws = family >= 0 && (device.getQueueFamilyProperties()[std::size_t(family)].queueFlags & vk::QueueFlagBits::eGraphics);
    features.blendsFloats = bool(device.getFormatProperties(vulkanFormat(FrameFormat::rgba32Float)).optimalTilingFeatures & vk::FormatFeatureFlagBits::eColorAttachmentBlend);
    features.diamondLines = hasDiamondLines(device);
    if (hasExtension(device, VK_EXT_SHADER_ATOMIC_FLOAT_EXTENSION_NAME)) {
        const auto chain = device.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceShaderAtomicFloatFeaturesEXT>();
        features.floatAtomics = chain.get<vk::PhysicalDeviceShaderAtomicFloatFeaturesEXT>().shaderBufferFloat32AtomicAdd;
    }
    const auto chain = device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceSubgroupProperties>();
    const auto& subgroup = chain.get<vk::PhysicalDeviceSubgroupProperties>();
    const bool shuffles = (subgroup.supportedStages & vk::ShaderStageFlagBits::eCompute) && (subgroup.supportedOperations & vk::SubgroupFeatureFlagBits::eShuffle);
    features.subgroupSize = shuffles ? subgroup.subgroupSize : 0;
    features.rayQueries = hasRayQueries(device);
    features.rayPipelines = hasRayPipelines(device);
    return features;
}

FrameLimits limitsOf(const vk::raii::PhysicalDevice& device) {
    const auto chain = device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceMaintenance3Properties>();
    const vk::PhysicalDeviceLimits& limits = chain.get<vk::PhysicalDeviceProperties2>().properties.limits;
    const std::uint64_t allocation = chain.get<vk::PhysicalDeviceMaintenance3Properties>().maxMemoryAllocationSize;
    return {.groups = *std::min_element(limits.maxComputeWorkGroupCount.begin(), limits.maxComputeWorkGroupCount.end()),
            .storageBuffers = limits.maxPerStageDescriptorStorageBuffers,
            .uniformBytes = limits.maxUniformBufferRange,
            .storageBytes = std::min<std::uint64_t>(limits.maxStorageBufferRange, allocation),
            .texelElements = limits.maxTexelBufferElements,
            .imageSide = std::min({limits.maxImageDimension2D, limits.maxFramebufferWidth, limits.maxFramebufferHeight}),
            .imageLayers = limits.maxImageArrayLayers,
            .volumeSide = limits.maxImageDimension3D,
            .colourTargets = std::min(limits.maxColorAttachments, limits.maxFragmentOutputAttachments),
            .raySenders = hasRayPipelines(device) ? rayPropertiesOf(device).maxRayDispatchInvocationCount : FrameLimits().raySenders};
}

std::string driverOf(const vk::raii::PhysicalDevice& device) {
    if (hasExtension(device, VK_KHR_DRIVER_PROPERTIES_EXTENSION_NAME)) {
        const auto chain = device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
        const auto& driver = chain.get<vk::PhysicalDeviceDriverProperties>();
        return std::string(driver.driverName.data()) + " " + driver.driverInfo.data();
    }
    const std::uint32_t v = device.getProperties().driverVersion;
    return std::to_string(VK_API_VERSION_MAJOR(v)) + "." + std::to_string(VK_API_VERSION_MINOR(v)) + "." + std::to_string(VK_API_VERSION_PATCH(v));
}

VulkanDeviceInfo describe(const vk::raii::PhysicalDevice& device) {
    const auto properties = device.getProperties();
    VulkanDeviceInfo info{.name = properties.deviceName.data(), .driver = driverOf(device), .type = typeName(properties.deviceType), .apiVersion = properties.apiVersion,
                          .memory = 0, .limits = limitsOf(device), .features = featuresOf(device)};
    for (const auto& heap : device.getMemoryProperties().memoryHeaps) {
        if (heap.flags & vk::MemoryHeapFlagBits::eDeviceLocal) info.memory = std::max<std::uint64_t>(info.memory, heap.size);
    }
    return info;
}

// Not empty.
std::vector<vk::raii::PhysicalDevice> usableDevices(const vk::raii::Instance& instance) {
    std::vector<vk::raii::PhysicalDevice> usable;
    for (const vk::raii::PhysicalDevice& device : vk::raii::PhysicalDevices(instance)) {
        if (device.getProperties().apiVersion >= VK_API_VERSION_1_1 && queueFamilyOf(device) >= 0) usable.push_back(device);
    }
    if (usable.empty()) throw std::runtime_error("Vulkan: no device with Vulkan 1.1 and compute");
    return usable;
}

vk::raii::PhysicalDevice chooseDevice(const vk::raii::Instance& instance, const std::string& wanted) {
    const auto devices = usableDevices(instance);
    std::size_t index = 0;
    const char* end = wanted.data() + wanted.size();
    const auto [rest, error] = std::from_chars(wanted.data(), end, index);
    if (!wanted.empty() && error == std::errc() && rest == end) {
        if (index < devices.size()) return devices[index];
        throw std::runtime_error("Vulkan: no device " + wanted + ", they count from 0 to " + std::to_string(devices.size() - 1));
    }
    std::string names;
    for (const auto& device : devices) {
        const auto properties = device.getProperties();
        const std::string name = properties.deviceName.data();
        const bool fits = wanted.empty() ? properties.deviceType == vk::PhysicalDeviceType::eDiscreteGpu : name.find(wanted) != std::string::npos;
        if (fits) return device;
        names += (names.empty() ? "" : ", ") + name;
    }
    if (wanted.empty()) return devices.front();
    throw std::runtime_error("Vulkan: no device with \"" + wanted + "\" in its name; there is " + names);
}

}  // namespace

std::vector<VulkanDeviceInfo> vulkanDevices(const std::string& loader) {
    return inWords([&] {
        const VulkanLoader library(loader);
        const vk::raii::Context context(library.entry());
        const vk::raii::Instance instance = makeInstance(context, false);
        std::vector<VulkanDeviceInfo> infos;
        for (const auto& device : usableDevices(instance)) infos.push_back(describe(device));
        return infos;
    });
}

InjectWay defaultInject(const VulkanFeatures& features, std::uint32_t rule) {
    // Gathers know track lengths alone; what the rays of the thesis' rule add is scattered.
    if (rule != kClvInjectTrackLength) return features.floatAtomics ? InjectWay::floatAtomics : InjectWay::fixedPoint;
    const bool wholeBricks = features.subgroupSize > 0 && features.subgroupSize % kClvBrickLanes == 0;
    return wholeBricks ? InjectWay::bricks : InjectWay::bricksPlain;
}

TraceWay defaultTrace(const VulkanDeviceInfo& info) {
    if (info.type == "cpu" || !info.features.hasRayTracing()) return TraceWay::walk;
    return info.features.rayQueries ? TraceWay::query : TraceWay::pipeline;
}

VulkanDevice::Impl::Impl(const VulkanOptions& options)
    : loader(options.loader), context(loader.entry()), instance(makeInstance(context, options.validate)), physical(chooseDevice(instance, options.device)),
      info(describe(physical)), enabled(info.features), queueFamily(std::uint32_t(queueFamilyOf(physical))),
      statesBudget(hasExtension(physical, VK_EXT_MEMORY_BUDGET_EXTENSION_NAME)) {
    if (options.validate) {
        using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
        using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
        messenger = vk::raii::DebugUtilsMessengerEXT(instance, {{}, Severity::eWarning | Severity::eError, Type::eValidation | Type::ePerformance, onMessage, this});
    }
    const std::uint32_t bits = physical.getQueueFamilyProperties()[queueFamily].timestampValidBits;
    timestampPeriod = bits > 0 ? physical.getProperties().limits.timestampPeriod : 0.0f;
    timestampMask = bits < 64 ? (std::uint64_t(1) << bits) - 1 : ~std::uint64_t(0);

    std::vector<const char*> extensions;
    vk::PhysicalDeviceShaderAtomicFloatFeaturesEXT atomics;
    atomics.shaderBufferFloat32AtomicAdd = true;
    if (options.floatAtomics) {
        if (!info.features.floatAtomics) throw std::runtime_error("Vulkan: " + info.name + " cannot add floats in buffers atomically");
        extensions.push_back(VK_EXT_SHADER_ATOMIC_FLOAT_EXTENSION_NAME);
    }
    enabled.floatAtomics = options.floatAtomics;
    vk::PhysicalDeviceLineRasterizationFeaturesEXT lines;
    lines.bresenhamLines = true;
    if (enabled.diamondLines) extensions.push_back(VK_EXT_LINE_RASTERIZATION_EXTENSION_NAME);
    enabled.rayQueries = options.rayQueries && info.features.rayQueries;
    enabled.rayPipelines = options.rayPipelines && info.features.rayPipelines;
    vk::PhysicalDeviceBufferDeviceAddressFeatures addresses(true);
    vk::PhysicalDeviceAccelerationStructureFeaturesKHR accelerations(true);
    vk::PhysicalDeviceRayQueryFeaturesKHR queries(true);
    vk::PhysicalDeviceRayTracingPipelineFeaturesKHR pipelines(true);
    accelerations.pNext = &addresses;
    if (enabled.hasRayTracing()) {
        for (const char* name : kAccelerationExtensions) extensions.push_back(name);
    }
    if (enabled.rayQueries) extensions.push_back(VK_KHR_RAY_QUERY_EXTENSION_NAME);
    if (enabled.rayPipelines) extensions.push_back(VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME);
    void* chain = nullptr;
    if (options.floatAtomics) chain = &atomics;
    if (enabled.diamondLines) lines.pNext = chain, chain = &lines;
    if (enabled.hasRayTracing()) addresses.pNext = chain, chain = &accelerations;
    if (enabled.rayQueries) queries.pNext = chain, chain = &queries;
    if (enabled.rayPipelines) pipelines.pNext = chain, chain = &pipelines;
    const float priority = 1.0f;
    const vk::DeviceQueueCreateInfo queues({}, queueFamily, 1, &priority);
    device = vk::raii::Device(physical, vk::DeviceCreateInfo({}, queues, {}, extensions, nullptr, chain));
    queue = vk::raii::Queue(device, queueFamily, 0);
}

VulkanDevice::VulkanDevice(const VulkanOptions& options) : impl_(inWords([&] { return std::make_unique<Impl>(options); })) {}
VulkanDevice::~VulkanDevice() = default;

const VulkanDeviceInfo& VulkanDevice::info() const { return impl_->info; }

std::uint64_t VulkanDevice::accelerationBytes(std::uint64_t triangles) const { return accelerationSizes(*impl_, triangles).bytes; }

std::vector<std::string> VulkanDevice::messages() const {
    const std::lock_guard lock(impl_->messageMutex);
    return impl_->messages;
}

}  // namespace clv
