#include "bindings/vulkan/vulkan_loader.h"

#include <stdexcept>

#include <dlfcn.h>

namespace clv {
namespace {

constexpr const char* kSystemLoader = "libvulkan.so.1";

}  // namespace

VulkanLoader::VulkanLoader(const std::string& fileName) {
    const std::string name = fileName.empty() ? kSystemLoader : fileName;
    library_ = std::shared_ptr<void>(dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL), [](void* library) {
        if (library != nullptr) dlclose(library);
    });
    if (library_ == nullptr) throw std::runtime_error("Vulkan: no loader: " + name + " cannot be opened");
    entry_ = reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library_.get(), "vkGetInstanceProcAddr"));
    if (entry_ == nullptr) throw std::runtime_error("Vulkan: no loader: " + name + " has no vkGetInstanceProcAddr");
}

std::string vulkanErrorText(const vk::SystemError& error) {
    switch (vk::Result(error.code().value())) {
        case vk::Result::eErrorDeviceLost: return "Vulkan: the device was lost";
        case vk::Result::eErrorOutOfDeviceMemory: return "Vulkan: the device is out of memory";
        case vk::Result::eErrorOutOfHostMemory: return "Vulkan: the host is out of memory";
        case vk::Result::eErrorIncompatibleDriver: return "Vulkan: no driver is installed";
        default: return std::string("Vulkan: ") + error.what();
    }
}

}  // namespace clv
