// Executes a Frame on a Vulkan device: its buffers, one pipeline a pass, one command buffer a step, recorded once.
#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bindings/vulkan/vulkan_device.h"
#include "clv/plan/frame.h"
#include "shaders/shader_code.h"

namespace clv {

class VulkanFrame {
public:
    // Takes all memory, makes all pipelines and records all commands: later calls do neither. The device must outlive it.
    // Throws std::runtime_error with one line.
    VulkanFrame(VulkanDevice& device, const Frame& frame, ShaderLanguage language = ShaderLanguage::glsl);
    ~VulkanFrame();
    VulkanFrame(const VulkanFrame&) = delete;
    VulkanFrame& operator=(const VulkanFrame&) = delete;

    // Host data into a buffer of that name, from its start. Waits for the device.
    template <class T>
    void upload(const std::string& buffer, std::span<const T> items) { uploadBytes(buffer, std::as_bytes(items)); }
    template <class T>
    void upload(const std::string& buffer, const T& item) { uploadBytes(buffer, std::as_bytes(std::span(&item, 1))); }
    // A buffer's first items; the buffer must be one that the frame lets the host read back.
    template <class T>
    void download(const std::string& buffer, std::span<T> items) const { downloadBytes(buffer, std::as_writable_bytes(items)); }

    // Runs one step and waits for its end.
    void run(const std::string& step);
    // Time of each pass of the step's last run, ms; empty where the device has no timestamps.
    std::vector<std::pair<std::string, double>> times(const std::string& step) const;

private:
    void uploadBytes(const std::string& buffer, std::span<const std::byte> bytes);
    void downloadBytes(const std::string& buffer, std::span<std::byte> bytes) const;

    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace clv
