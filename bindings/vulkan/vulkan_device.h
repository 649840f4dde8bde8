// A Vulkan device with one queue, chosen by index or name.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "clv/plan/frame_check.h"
#include "clv/plan/light_frame.h"

namespace clv {

// What this library may use of a device where it is there.
struct VulkanFeatures {
    bool floatAtomics = false;       // 32-bit float additions in storage buffers
    std::uint32_t subgroupSize = 0;  // lanes that can shuffle in compute; 0: none can
    bool rayQueries = false;         // of acceleration structures, in compute
    bool rayPipelines = false;       // ray-tracing pipelines that search them
    bool draws = false;              // the queue takes passes that draw
    bool blendsFloats = false;       // adds up colours of 32-bit floats in targets
    bool diamondLines = false;       // lines by the diamond-exit rule

    bool hasRayTracing() const { return rayQueries || rayPipelines; }
};

struct VulkanDeviceInfo {
    std::string name;
    std::string driver;              // name and version
    std::string type;                // "discrete", "integrated", "virtual", "cpu" or "other"
    std::uint32_t apiVersion = 0;    // as Vulkan encodes it
    std::uint64_t memory = 0;        // bytes of the largest device-local heap
    FrameLimits limits;
    VulkanFeatures features;
};

struct VulkanOptions {
    std::string device{};            // index or part of a name; empty: the first discrete one, else the first
    bool floatAtomics = false;       // switch them on, for shaders that add floats in buffers
    bool rayQueries = false;         // switch them on where the device has them
    bool rayPipelines = false;       // the same of ray-tracing pipelines
    bool validate = false;           // Khronos' validation layer with synchronisation validation; its messages count as errors
    std::string loader{};            // file name of the Vulkan loader's library; empty: the system's
};

// Devices that can run compute with Vulkan 1.1, in the loader's order.
// Throws std::runtime_error with one line that says why there is none.
std::vector<VulkanDeviceInfo> vulkanDevices(const std::string& loader = {});

// How a device with these features adds up crossings by `rule` (kClvInject...), unless told otherwise.
InjectWay defaultInject(const VulkanFeatures& features, std::uint32_t rule = kClvInjectTrackLength);

// How rays find triangles on a device whose ray tracing is switched on, where it has any: by queries, which need no table of shaders and
// no rays in memory, else by pipelines; a processor takes longer with its own than with the walk.
TraceWay defaultTrace(const VulkanDeviceInfo& info);

class VulkanDevice {
public:
    // Throws std::runtime_error with one line: no loader, no driver, no device, no such device, a missing feature.
    explicit VulkanDevice(const VulkanOptions& options = {});
    ~VulkanDevice();
    VulkanDevice(const VulkanDevice&) = delete;
    VulkanDevice& operator=(const VulkanDevice&) = delete;

    const VulkanDeviceInfo& info() const;
    // What an acceleration structure of so many triangles takes, for LightFrameSettings; ray tracing of a kind is switched on.
    std::uint64_t accelerationBytes(std::uint64_t triangles) const;
    // What the validation layer has said so far, a line each.
    std::vector<std::string> messages() const;

    struct Impl;
    Impl& impl() const { return *impl_; }

private:
    std::unique_ptr<Impl> impl_;
};

}  // namespace clv
