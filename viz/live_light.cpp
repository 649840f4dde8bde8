#include "viz/live_light.h"

#include <algorithm>

#include "bindings/volume_file/moving_cascades.h"

namespace clv {
namespace {

// One volume over the scene. It snaps to whole cells: one at each end is room for that, and for the air before the outermost surfaces.
CascadeDesc cubeOver(const Scene& scene, int resolution) {
    const vec3 extent = scene.bounds.extent();
    return {.count = 1, .resolution = ivec3(resolution), .finestCellSize = double(std::max({extent.x, extent.y, extent.z})) / double(resolution - 2), .marginCells = 0};
}

MovingLightOptions optionsOf(const World& world, const LiveSettings& live, const Camera& camera) {
    return {.cascades = live.cascades > 0 ? cascadesAround(world.scene(), camera, live.cascades, live.resolution, 0.0) : cubeOver(world.scene(), live.resolution),
            .storage = live.storage,
            .rays = std::size_t(live.rays),
            .stillTime = float(live.historyTime),
            .movingTime = float(live.movingTime)};
}

}  // namespace

LiveLight::LiveLight(const World& world, const LiveSettings& settings, const Camera& camera, const ParallelFor& parallelFor)
    : world_(world), settings_(settings), light_(world.embree(), optionsOf(world, settings, camera), parallelFor) {
    if (settings.cascades == 0) light_.moveTo({.position = glm::dvec3(world.scene().bounds.center()) + world.scene().anchor}, world.scene().name);
}

void LiveLight::frame(float timestep, const Camera& camera, BakedVolume& volume) {
    if (settings_.cascades > 0) light_.moveTo(viewOf(world_.scene(), camera), world_.scene().name);
    light_.frame(timestep);
    volume.layout = light_.layout();
    volume.lights = world_.scene().lights;
    volume.camera = camera;
    volume.frame = light_.frames();
    keepCascades(light_.lighting(), double(settings_.rays), volume);
}

}  // namespace clv
