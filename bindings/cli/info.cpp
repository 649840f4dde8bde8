// clv info: what this build and this machine offer.
#include <memory>
#include <thread>

#include <fmt/format.h>

#include "bindings/cli/command_line.h"
#include "bindings/cli/options.h"
#include "bindings/vulkan/vulkan_device.h"

namespace clv {
namespace {

// Of the instruction sets that matter to the loops here, those that this processor has.
Report cpuFeatures() {
    Report features = Report::array();
#if defined(__x86_64__)
    if (__builtin_cpu_supports("sse4.2")) features.push_back("sse4.2");
    if (__builtin_cpu_supports("avx2")) features.push_back("avx2");
    if (__builtin_cpu_supports("fma")) features.push_back("fma");
    if (__builtin_cpu_supports("avx512f")) features.push_back("avx512f");
#endif
    return features;
}

std::string injectName(InjectWay way) {
    switch (way) {
        case InjectWay::bricks: return "bricks";
        case InjectWay::bricksPlain: return "bricks without subgroups";
        case InjectWay::floatAtomics: return "float atomics";
        default: return "fixed point";
    }
}

std::string traceName(TraceWay way) {
    switch (way) {
        case TraceWay::query: return "ray queries in compute";
        case TraceWay::pipeline: return "ray-tracing pipelines";
        default: return "bvh in compute";
    }
}

// A row a device: what it is, and the path that a frame takes on it.
void addVulkanDevices(Report& report) {
    Report rows = Report::array();
    try {
        for (const VulkanDeviceInfo& device : vulkanDevices()) {
            rows.push_back({{"index", rows.size()},
                            {"name", device.name},
                            {"type", device.type},
                            {"driver", device.driver},
                            {"vulkan", fmt::format("{}.{}.{}", device.apiVersion >> 22 & 0x7fu, device.apiVersion >> 12 & 0x3ffu, device.apiVersion & 0xfffu)},
                            {"memory_mib", device.memory >> 20},
                            {"subgroup_size", device.features.subgroupSize},
                            {"inject", injectName(defaultInject(device.features))},
                            {"trace", traceName(defaultTrace(device))}});
        }
    } catch (const std::runtime_error& error) {
        report["vulkan_missing"] = error.what();
    }
    if (!rows.empty()) report["backends"].push_back("vulkan");
    report["vulkan_devices"] = std::move(rows);
}

}  // namespace

void addInfoCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand("info", "Say what this build and this machine offer");
    auto options = std::make_shared<CommonOptions>();
    addCommonOptions(*command, *options);
    command->callback([options, command] {
        Report report = startReport(*command, *options);
        report["version"] = CLV_VERSION;
        report["hardware_threads"] = std::thread::hardware_concurrency();
        report["cpu_features"] = cpuFeatures();
        report["backends"] = Report::array({"cpu"});
        addVulkanDevices(report);
        printReport(report, *options);
    });
}

}  // namespace clv
