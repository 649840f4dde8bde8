#include "bindings/vulkan/vulkan_device.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "bindings/vulkan/vulkan_device_impl.h"

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
    const vk::InstanceCreateInfo create({}, &application, layers, extensions, validate ? &features : nullptr);
    return vk::raii::Instance(context, create);
}

bool hasExtension(const vk::raii::PhysicalDevice& device, const char* name) {
    const auto extensions = device.enumerateDeviceExtensionProperties();
    return std::any_of(extensions.begin(), extensions.end(), [&](const auto& e) { return std::string(e.extensionName.data()) == name; });
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

VulkanDeviceInfo describe(const vk::raii::PhysicalDevice& device) {
    VulkanDeviceInfo info;
    const auto properties = device.getProperties();
    info.name = properties.deviceName.data();
    info.apiVersion = properties.apiVersion;
    info.type = typeName(properties.deviceType);
    const std::uint32_t v = properties.driverVersion;
    info.driver = std::to_string(VK_API_VERSION_MAJOR(v)) + "." + std::to_string(VK_API_VERSION_MINOR(v)) + "." + std::to_string(VK_API_VERSION_PATCH(v));
    if (hasExtension(device, VK_KHR_DRIVER_PROPERTIES_EXTENSION_NAME)) {
        const auto chain = device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
        const auto& driver = chain.get<vk::PhysicalDeviceDriverProperties>();
        info.driver = std::string(driver.driverName.data()) + " " + driver.driverInfo.data();
    }
    for (const auto& heap : device.getMemoryProperties().memoryHeaps) {
        if (heap.flags & vk::MemoryHeapFlagBits::eDeviceLocal) info.memory = std::max<std::uint64_t>(info.memory, heap.size);
    }
    if (hasExtension(device, VK_EXT_SHADER_ATOMIC_FLOAT_EXTENSION_NAME)) {
        const auto chain = device.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceShaderAtomicFloatFeaturesEXT>();
        info.features.floatAtomics = chain.get<vk::PhysicalDeviceShaderAtomicFloatFeaturesEXT>().shaderBufferFloat32AtomicAdd;
    }
    const auto chain = device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceSubgroupProperties>();
    const auto& subgroup = chain.get<vk::PhysicalDeviceSubgroupProperties>();
    const bool shuffles = (subgroup.supportedStages & vk::ShaderStageFlagBits::eCompute) && (subgroup.supportedOperations & vk::SubgroupFeatureFlagBits::eShuffle);
    info.features.subgroupSize = shuffles ? subgroup.subgroupSize : 0;
    info.features.rayTracingPipelines = hasExtension(device, VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME);
    return info;
}

int computeFamily(const vk::raii::PhysicalDevice& device) {
    const auto families = device.getQueueFamilyProperties();
    for (std::size_t i = 0; i < families.size(); ++i) {
        if (families[i].queueFlags & vk::QueueFlagBits::eCompute) return int(i);
    }
    return -1;
}

std::vector<vk::raii::PhysicalDevice> usableDevices(const vk::raii::Instance& instance) {
    std::vector<vk::raii::PhysicalDevice> usable;
    for (const vk::raii::PhysicalDevice& device : vk::raii::PhysicalDevices(instance)) {
        if (device.getProperties().apiVersion >= VK_API_VERSION_1_1 && computeFamily(device) >= 0) usable.push_back(device);
    }
    return usable;
}

std::size_t chooseDevice(const std::vector<vk::raii::PhysicalDevice>& devices, const std::string& wanted) {
    if (devices.empty()) throw std::runtime_error("Vulkan: no device with Vulkan 1.1 and compute");
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
    if (!wanted.empty() && error == std::errc() && end == wanted.data() + wanted.size()) {
        if (index < devices.size()) return index;
        throw std::runtime_error("Vulkan: no device " + wanted + ", there are " + std::to_string(devices.size()));
    }
    for (std::size_t i = 0; i < devices.size(); ++i) {
        const auto properties = devices[i].getProperties();
        const bool fits = wanted.empty() ? properties.deviceType == vk::PhysicalDeviceType::eDiscreteGpu
                                         : std::string(properties.deviceName.data()).find(wanted) != std::string::npos;
        if (fits) return i;
    }
    if (wanted.empty()) return 0;
    throw std::runtime_error("Vulkan: no device with \"" + wanted + "\" in its name");
}

}  // namespace

std::vector<VulkanDeviceInfo> vulkanDevices() {
    std::vector<VulkanDeviceInfo> infos;
    try {
        const vk::raii::Context context;
        const vk::raii::Instance instance = makeInstance(context, false);
        for (const auto& device : usableDevices(instance)) infos.push_back(describe(device));
    } catch (const std::exception&) {
        // No loader, or one without any driver: there are no devices.
    }
    return infos;
}

VulkanDevice::VulkanDevice(const VulkanOptions& options) : impl_(std::make_unique<Impl>()) {
    Impl& d = *impl_;
    try {
        d.instance = makeInstance(d.context, options.validate);
        if (options.validate) {
            using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
            using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
            d.messenger = vk::raii::DebugUtilsMessengerEXT(d.instance, vk::DebugUtilsMessengerCreateInfoEXT({}, Severity::eWarning | Severity::eError,
                                                                                                             Type::eValidation | Type::ePerformance, onMessage, &d));
        }
        const auto devices = usableDevices(d.instance);
        d.physical = devices[chooseDevice(devices, options.device)];
        d.info = describe(d.physical);
        d.queueFamily = std::uint32_t(computeFamily(d.physical));
        const bool timestamps = d.physical.getQueueFamilyProperties()[d.queueFamily].timestampValidBits > 0;
        d.timestampPeriod = timestamps ? d.physical.getProperties().limits.timestampPeriod : 0.0f;

        const float priority = 1.0f;
        const vk::DeviceQueueCreateInfo queue({}, d.queueFamily, 1, &priority);
        std::vector<const char*> extensions;
        vk::PhysicalDeviceShaderAtomicFloatFeaturesEXT atomics;
        atomics.shaderBufferFloat32AtomicAdd = true;
        if (d.info.features.floatAtomics) extensions.push_back(VK_EXT_SHADER_ATOMIC_FLOAT_EXTENSION_NAME);
        const vk::PhysicalDeviceFeatures features{};
        const vk::DeviceCreateInfo create({}, queue, {}, extensions, &features, d.info.features.floatAtomics ? &atomics : nullptr);
        d.device = vk::raii::Device(d.physical, create);
        d.queue = vk::raii::Queue(d.device, d.queueFamily, 0);
    } catch (const vk::SystemError& error) {
        throw std::runtime_error(std::string("Vulkan: ") + error.what());
    }
}

VulkanDevice::~VulkanDevice() = default;

const VulkanDeviceInfo& VulkanDevice::info() const { return impl_->info; }

std::vector<std::string> VulkanDevice::messages() const {
    const std::lock_guard lock(impl_->messageMutex);
    return impl_->messages;
}

}  // namespace clv
