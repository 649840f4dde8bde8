// Executes a Frame on a Vulkan device: its buffers and images, one pipeline a pass, one command buffer a step, recorded once.
#pragma once
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/vulkan/vulkan_device.h"
#include "clv/plan/frame.h"
#include "shaders/shader_code.h"

namespace clv {

class VulkanFrame {
public:
    // Takes all memory, makes all pipelines and records all commands: later calls do neither. The device must outlive it; `lender`, whose
    // buffers it shares, need not.
    // Throws std::runtime_error with one line: a description with a fault, a shader that does not match it, too little memory.
    VulkanFrame(VulkanDevice& device, const Frame& frame, ShaderLanguage language = ShaderLanguage::glsl, const VulkanFrame* lender = nullptr);
    ~VulkanFrame();
    VulkanFrame(const VulkanFrame&) = delete;
    VulkanFrame& operator=(const VulkanFrame&) = delete;

    // Host data into a buffer of that name, from its start; passes see it from the next run on.
    template <class T>
    void upload(std::string_view buffer, std::span<const T> items) { uploadBytes(buffer, std::as_bytes(items)); }
    template <class T>
    void upload(std::string_view buffer, const T& item) { uploadBytes(buffer, std::as_bytes(std::span(&item, 1))); }
    // A buffer's first items, or all texels of an image; it must be one that the frame lets the host read back.
    template <class T>
    void download(std::string_view buffer, std::span<T> items) { downloadBytes(buffer, std::as_writable_bytes(items)); }

    // Runs steps in this order, in one submission together with the uploads since the last, and waits for their end.
    void run(std::initializer_list<std::string_view> steps) { runSteps({steps.begin(), steps.size()}); }
    void run(std::string_view step) { runSteps({&step, 1}); }
    // Time of each pass of the step's last run, ms; empty where the device has no timestamps.
    std::vector<std::pair<std::string, double>> times(std::string_view step) const;

private:
    void uploadBytes(std::string_view buffer, std::span<const std::byte> bytes);
    void downloadBytes(std::string_view buffer, std::span<std::byte> bytes);
    void runSteps(std::span<const std::string_view> steps);

    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace clv
