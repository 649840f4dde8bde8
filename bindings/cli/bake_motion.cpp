#include "bindings/cli/bake_motion.h"

#include <algorithm>

#include <fmt/format.h>

#include "bindings/cli/camera_view.h"
#include "bindings/cli/heed_lights.h"
#include "bindings/cli/moving_light.h"
#include "bindings/cli/progress.h"
#include "bindings/embree/light_check.h"
#include "bindings/embree/light_maps.h"
#include "bindings/volume_file/moving_cascades.h"

namespace clv {
namespace {

BakedVolume describe(const Scene& scene, std::uint32_t seed, const DepositLayout& layout) {
    BakedVolume volume;
    volume.scene = scene.name;
    volume.mark = markOf(scene);
    volume.libraryVersion = CLV_VERSION;
    volume.anchor = scene.anchor;
    volume.seed = seed;
    volume.layout = layout;
    return volume;
}

// Of the rays of the last frame.
double shareThatMeets(std::span<const ClvRay> rays) {
    const auto meets = std::ranges::count_if(rays, [](const ClvRay& ray) { return ray.maxDistance > 0.0f && ray.maxDistance < kClvFar; });
    return rays.empty() ? 0.0 : double(meets) / double(rays.size());
}

PipelineReport reportOf(const MovingLight& light, const LightOptions& options) {
    PipelineReport report;
    report.rays = options.rays * light.frames();
    report.levels = {{options.resolution, 1.0}};
    report.shareThatMeets = shareThatMeets(light.lighting().currentRays());
    report.sweeps = 1;
    report.bytes = light.lighting().bytes();
    for (const MovingVolume& volume : light.lighting().volumes()) report.slots += volume.level().slots.size();
    report.channels = light.layout().channels;
    report.stages = light.allStages();
    for (const auto& [name, seconds] : report.stages) report.frameSeconds += name == "rsm" ? 0.0 : seconds;
    return report;
}

}  // namespace

PipelineReport bakeMotion(const Scene& scene, const Motion& motion, const LightOptions& options, const CascadeOptions& cascades, std::uint32_t seed,
                          const ParallelFor& parallelFor, const std::function<void(const BakedVolume&)>& onFrame) {
    Scene moving = scene;
    std::optional<EmbreeScene> embree(moving);
    const bool follows = cascades.count > 0;
    // What the motion does not say of the camera is that of the scene's.
    Camera still;
    if (follows && !(motion.camera && scene.cameras.empty())) still = chooseCamera(scene, cascades.camera);
    const auto cameraOf = [&](std::uint32_t frame) { return cameraAt(motion, scene, still, frame); };

    const CascadeDesc desc = follows ? cascadesAround(scene, cameraOf(0), cascades.count, options.resolution, cascades.cellSize) : gridOver(scene, options.resolution);
    moving.lights = lightsAt(motion, scene, 0);
    LightHeed heed = heedLights(*embree, float(desc.finestCellSize), double(options.rays) * options.frames, parallelFor);
    if (heed.insideOut) {
        turnFaces(moving);
        embree.emplace(moving);
    }
    embree->setSolids(!heed.sheets);
    MovingLight light(*embree, {.cascades = desc, .storage = options.storage, .rays = std::size_t(options.rays), .seed = seed}, parallelFor);
    BakedVolume volume = describe(scene, seed, light.layout());
    Progress progress("light");
    bool lit = false;
    for (std::uint32_t frame = 0; frame < options.frames; ++frame) {
        moving.lights = lightsAt(motion, scene, frame);
        lit = lit || !lightsThatSend(moving).empty();
        if (follows) {
            volume.camera = cameraOf(frame);
            light.moveTo(viewOf(scene, *volume.camera), fmt::format("{}: frame {}", motion.camera ? motion.file : scene.name, frame));
        } else if (frame == 0) {
            light.moveTo({.position = scene.anchor + glm::dvec3(scene.bounds.center())}, scene.name);
        }
        light.frame(float(1.0 / motion.fps));
        volume.lights = moving.lights;
        volume.frame = frame;
        keepCascades(light.lighting(), double(options.rays), volume);
        onFrame(volume);
        progress.update(double(frame + 1) / double(options.frames));
    }
    if (!lit) throw InputError(scene.name + ": no light is on; expected one to bake");
    PipelineReport report = reportOf(light, options);
    report.warnings = std::move(heed.warnings);
    return report;
}

}  // namespace clv
