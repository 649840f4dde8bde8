// This library on a Vulkan device, from maps to irradiance, behind the interface of the methods that it is compared with.
#pragma once
#include <memory>
#include <string>

#include "benchmarks/baselines/readers.h"

namespace clv {

struct VulkanVolumeSettings {
    std::string device;                   // index or a part of its name
    int resolution = 32;                  // about resolution^3 cells
    Readers readers = Readers::surfaces;  // cells that nobody reads have no slot
};

// Rays are those of makeLightVolume at the same resolution, unguided; receivers stand still. prepare() throws std::runtime_error where the
// device cannot be had.
std::unique_ptr<Method> makeVulkanVolume(const VulkanVolumeSettings& settings);

}  // namespace clv
