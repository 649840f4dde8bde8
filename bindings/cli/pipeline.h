// The light pipeline of the commands: from a scene to indirect irradiance at points, stage by stage, with the time of each.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bindings/cli/light_options.h"
#include "bindings/cli/noise.h"
#include "bindings/cli/options.h"
#include "bindings/embree/embree_scene.h"
#include "bindings/embree/path_tracer.h"
#include "clv/cpu/parallel.h"

namespace clv {

struct PipelineReport {
    // s of run time. "setup" is what a still scene needs once (acceleration structure, open regions of cells), "rsm" the reflective
    // shadow maps; the others make up the frames.
    std::vector<std::pair<std::string, double>> stages;
    double frameSeconds = 0.0;             // rays to evaluate, all frames together
    std::uint64_t rays = 0;                // segments traced after the first bounce, pilots included
    std::uint32_t sweeps = 0;              // bounces that rays followed, the last one perhaps for all that are left
    std::optional<Noise> noise;            // at the points; known where the resolution is chosen
    double contraction = 0.0;              // power from bounce to bounce, of the channel that loses least
    std::vector<std::pair<int, double>> levels;  // resolution and weight of each level that is shown
    std::size_t bytes = 0;                 // of volumes and their tables
    std::size_t slots = 0;
    int channels = 0;                      // 0: nothing was stored
    double shareThatMeets = 0.0;           // of the pilot rays: what remains leaves the scene
    bool guided = false;                   // whether the other rays are sent to where the pilots met something
    std::string backend = "cpu";           // or "vulkan"
    std::string device;                    // of Vulkan
    std::string whyCpu;                    // where "auto" came to the CPU
    std::vector<std::string> warnings;
};

// Runs on the back end that the options choose; "auto" tries a GPU first, and says in the report why it came to the CPU. `run` gets the
// options with that choice made.
PipelineReport onBackend(const LightOptions& options, const std::function<PipelineReport(const LightOptions&)>& run);

// Indirect irradiance (W/m^2, without the static ambient term) at `points`, which are relative to the scene's anchor. `out` has the
// same size. Results depend on the options and the seed, never on the number of threads; at a fixed resolution the value at a point
// does not depend on the other points. Throws std::runtime_error where the back end that is asked for cannot be had or fails.
PipelineReport lightPoints(const Scene& scene, const LightOptions& options, std::uint32_t seed, const ParallelFor& parallelFor,
                           std::span<const ReferencePoint> points, std::span<glm::vec3> out);

// Says in `report` what ran: levels, rays, bytes, the milliseconds of each stage. Warnings go to stderr, a line each.
void reportLight(const PipelineReport& run, Report& report);

}  // namespace clv
