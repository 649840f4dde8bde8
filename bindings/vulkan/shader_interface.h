// What a shader's SPIR-V says that it needs, and whether a pass gives it.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bindings/vulkan/vulkan_device.h"
#include "clv/plan/frame.h"

namespace clv {

struct ShaderBinding {
    std::uint32_t number = 0;
    FrameBinding kind = FrameBinding::storage;
    bool writable = false;   // the shader does not declare it read-only
    bool integers = false;   // of a typed view or an image
    FrameShape shape = FrameShape::flat;  // of an image
};

struct ShaderInterface {
    std::vector<ShaderBinding> bindings;      // of descriptor set 0
    std::vector<std::uint32_t> constants;     // ids of specialisation constants
    bool floatAtomics = false, shuffles = false, rayQueries = false, rayPipelines = false;  // needed of the device
};

// Throws std::runtime_error for words that are no SPIR-V.
ShaderInterface shaderInterface(std::span<const std::uint32_t> words);

// What two shaders of a pass need together.
ShaderInterface together(const ShaderInterface& a, const ShaderInterface& b);

// How the pass and its shader differ, and what the device lacks for it, a line each; empty: it may run.
std::vector<std::string> shaderMismatches(const Frame& frame, const FramePass& pass, const ShaderInterface& shader, const VulkanFeatures& features);

}  // namespace clv
