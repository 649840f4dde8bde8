#include "bindings/cli/pipeline.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "bindings/cli/first_bounce.h"
#include "bindings/cli/further_bounces.h"
#include "bindings/cli/standard_streams.h"
#include "bindings/vulkan/vulkan_device.h"

namespace clv {
namespace {

// The first device that is none of the processor's own, which would only do with more effort what the processor does.
std::optional<std::string> firstGpu(const std::string& loader) {
    const std::vector<VulkanDeviceInfo> devices = vulkanDevices(loader);
    const auto isGpu = [](const VulkanDeviceInfo& device) { return device.type != "cpu"; };
    auto found = std::ranges::find(devices, std::string("discrete"), &VulkanDeviceInfo::type);
    if (found == devices.end()) found = std::ranges::find_if(devices, isGpu);
    if (found == devices.end()) return {};
    return std::to_string(found - devices.begin());
}

}  // namespace

PipelineReport onBackend(const LightOptions& options, const std::function<PipelineReport(const LightOptions&)>& run) {
    const auto by = [&](const std::string& backend, LightOptions chosen) {
        chosen.backend.choice = backend;
        return run(chosen);
    };
    if (options.backend.choice != "auto") return run(options);
    std::string reason = "Vulkan has no device but the processor itself";
    try {
        LightOptions onGpu = options;
        std::optional<std::string> gpu = options.backend.device;
        if (gpu->empty()) gpu = firstGpu(options.backend.loader);
        if (gpu) {
            onGpu.backend.device = *gpu;
            return by("vulkan", onGpu);
        }
    } catch (const std::runtime_error& error) {
        reason = error.what();
    }
    PipelineReport report = by("cpu", options);
    report.whyCpu = reason;
    return report;
}

PipelineReport lightPoints(const Scene& scene, const LightOptions& options, std::uint32_t seed, const ParallelFor& parallelFor,
                           std::span<const ReferencePoint> points, std::span<glm::vec3> out) {
    return onBackend(options, [&](const LightOptions& chosen) {
        std::fill(out.begin(), out.end(), glm::vec3(0.0f));
        LightJob job(scene, chosen, seed, parallelFor, points);
        if (job.worksAtAll()) {
            FirstBounce first(job);
            std::optional<FurtherBounces> further;
            if (job.needs.feedback) further.emplace(job);
            first.run([&](std::uint32_t, std::size_t rays, double target) {
                if (further) further->follow(first, rays, target);
            });
            const std::span<const LitLevel> later = further ? further->finish(first) : std::span<const LitLevel>();
            job.evaluate(first.levels(), out);
            job.evaluate(later, out);
            job.judgeNoise(first.levels(), later);
        }
        return job.takeReport();
    });
}

void reportLight(const PipelineReport& run, Report& report) {
    report["backend"] = run.backend;
    if (!run.device.empty()) report["device"] = run.device;
    if (!run.whyCpu.empty()) {
        report["why_cpu"] = run.whyCpu;
        sayOnStderr("clv: --backend auto takes the CPU: " + run.whyCpu);
    }
    Report levels = Report::array();
    for (const auto& [resolution, weight] : run.levels) levels.push_back({{"resolution", resolution}, {"weight", weight}});
    report["levels"] = levels;
    report["rays"] = run.rays;
    report["sweeps"] = run.sweeps;
    if (run.noise) report["noise"] = {{"of_mean", run.noise->ofMean}, {"noisy_points", run.noise->noisy}, {"dark_points", run.noise->dark}};
    report["channels"] = run.channels;
    report["share_of_rays_that_meet"] = run.shareThatMeets;
    report["guided"] = run.guided;
    report["slots"] = run.slots;
    report["bytes"] = run.bytes;
    Report stages = Report::object();
    for (const auto& [name, seconds] : run.stages) stages[name + "_ms"] = 1e3 * seconds;
    report["stages"] = stages;
    report["frame_ms"] = 1e3 * run.frameSeconds;
    if (!run.warnings.empty()) report["warnings"] = run.warnings;
    for (const std::string& warning : run.warnings) sayOnStderr("clv: " + warning);
}

}  // namespace clv
