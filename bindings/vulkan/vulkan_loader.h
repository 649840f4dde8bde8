// Vulkan's loader, opened at run time, and its errors in words.
#pragma once
#include <memory>
#include <string>

#include <vulkan/vulkan_raii.hpp>

namespace clv {

// The loader's library; closed when the object goes.
class VulkanLoader {
public:
    // `fileName` empty: the system's. Throws std::runtime_error where there is none.
    explicit VulkanLoader(const std::string& fileName);

    PFN_vkGetInstanceProcAddr entry() const { return entry_; }

private:
    std::shared_ptr<void> library_;
    PFN_vkGetInstanceProcAddr entry_ = nullptr;
};

// One line for people.
std::string vulkanErrorText(const vk::SystemError& error);

// Calls `f`; an error of Vulkan's becomes a std::runtime_error with one line.
template <class Function>
auto inWords(Function&& f) {
    try {
        return f();
    } catch (const vk::SystemError& error) {
        throw std::runtime_error(vulkanErrorText(error));
    }
}

}  // namespace clv
