#include "viz/live_light.h"

#include <algorithm>

#include "bindings/embree/light_maps.h"
#include "bindings/volume_file/moving_cascades.h"

namespace clv {
namespace {

DepositLayout layoutOf(const LiveSettings& settings) { return {.storage = settings.storage}; }

MovingLightingSettings settingsOf(const World& world, const LiveSettings& live) {
    const vec3 extent = world.scene().bounds.extent();
    MovingLightingSettings settings;
    settings.cascades.count = 1;
    settings.cascades.marginCells = 0;
    settings.cascades.resolution = ivec3(live.resolution);
    // The volume snaps to whole cells: one at each end is room for that, and for the air before the outermost surfaces.
    settings.cascades.finestCellSize = std::max({extent.x, extent.y, extent.z}) / double(live.resolution - 2);
    settings.anchor = world.scene().anchor;
    settings.layout = layoutOf(live);
    settings.movingLights = true;
    settings.originOffset = world.embree().surfaceOffset();
    settings.merge.stillTime = std::max(live.historyTime, live.movingTime);
    settings.merge.movingTime = live.movingTime;
    return settings;
}

}  // namespace

LiveLight::LiveLight(const World& world, const LiveSettings& settings, const ParallelFor& parallelFor)
    : world_(world), settings_(settings), parallelFor_(parallelFor),
      lighting_(settingsOf(world, settings), world.embree().probe(), [&world](std::span<ClvRay> rays) { world.embree().trace(rays); }, parallelFor) {
    lighting_.moveTo({.position = glm::dvec3(world.scene().bounds.center()) + world.scene().anchor});
}

void LiveLight::frame(float timestep, BakedVolume& volume) {
    clock_ = {};
    TexelSampler sampler;
    LightMaps maps(world_.embree(), 1, parallelFor_);
    clock_.time("rsm", [&] { sampler.build(maps.render(frames_), maps.side(), parallelFor_); });
    clock_.time("rays", [&] { lighting_.rays(sampler, settings_.rays); });
    clock_.time("trace", [&] { lighting_.trace(); });
    clock_.time("inject", [&] { lighting_.inject(); });
    clock_.time("merge", [&] { lighting_.merge(timestep); });
    ++frames_;
    volume.layout = layoutOf(settings_);
    volume.lights = world_.scene().lights;
    volume.frame = frames_;
    keepCascades(lighting_, double(settings_.rays), volume);
}

}  // namespace clv
