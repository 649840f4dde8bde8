// Stored cases on a device: does it compute what the CPU computed?
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "bindings/vulkan/vulkan_device.h"

namespace clv {

struct CaseResult {
    std::string name, language, way;  // to inject; empty where nothing is
    std::string trace;  // the way to; empty where nothing is traced
    bool passed = false;
    std::string words;  // what was found, one line
};

// Every case of the folder, in both shading languages, by every way to inject and to trace that the device can take; what is added up in integers
// twice, which must give the same bits. The device must have its features switched on.
std::vector<CaseResult> checkCases(VulkanDevice& device, const std::filesystem::path& folder);

}  // namespace clv
