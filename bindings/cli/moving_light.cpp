#include "bindings/cli/moving_light.h"

#include <algorithm>

#include <fmt/format.h>

#include "bindings/embree/light_maps.h"

namespace clv {
namespace {

MovingLightingSettings settingsOf(const EmbreeScene& scene, const MovingLightOptions& options) {
    MovingLightingSettings settings;
    settings.cascades = options.cascades;
    settings.anchor = scene.scene().anchor;
    settings.layout = {.storage = options.storage};
    settings.seed = options.seed;
    settings.originOffset = scene.surfaceOffset();
    settings.movingLights = true;
    // A single volume is filled in two pieces at the same time; several volumes are so as they are.
    settings.chunks = options.cascades.count == 1 ? 2 : 1;
    settings.merge.stillTime = std::max(options.stillTime, options.movingTime);
    settings.merge.movingTime = options.movingTime;
    if (const std::string problem = validate(settings); !problem.empty()) throw InputError(problem);
    return settings;
}

}  // namespace

CascadeDesc gridOver(const Scene& scene, int resolution) {
    const ClvVolume grid = volumeOverBounds(scene.bounds.lo, scene.bounds.hi, resolution, kClvStorageCube9);
    CascadeDesc desc{.count = 1, .resolution = ivec3(0), .finestCellSize = double(grid.cellSize), .marginCells = 0};
    // It snaps to whole cells: one more at each end is room for that.
    for (int axis = 0; axis < 3; ++axis) desc.resolution[axis] = std::max(4, grid.resolution[axis] + 2);
    return desc;
}

CascadeDesc cascadesAround(const Scene& scene, const Camera& camera, int count, int resolution, double cellSize) {
    CascadeDesc desc{.count = count, .resolution = ivec3(resolution), .finestCellSize = cellSize};
    if (cellSize == 0.0) {
        desc.finestCellSize = 1.0;
        const vec3 farthest = glm::max(glm::abs(scene.bounds.lo - camera.position), glm::abs(scene.bounds.hi - camera.position));
        desc.finestCellSize = double(std::max({farthest.x, farthest.y, farthest.z})) / heldRadius(desc, desc.count - 1);
    }
    return desc;
}

CameraView viewOf(const Scene& scene, const Camera& camera) {
    return {.position = scene.anchor + glm::dvec3(camera.position), .forward = glm::normalize(glm::dvec3(camera.forward)), .yfov = camera.yfov, .aspect = camera.aspect};
}

MovingLight::MovingLight(const EmbreeScene& scene, const MovingLightOptions& options, const ParallelFor& parallelFor)
    : scene_(scene), options_(options), parallelFor_(parallelFor), settings_(settingsOf(scene, options)),
      lighting_(settings_, scene.probe(), [&scene](std::span<ClvRay> rays) { scene.trace(rays); }, parallelFor) {}

void MovingLight::moveTo(const CameraView& view, const std::string& place) {
    if (const std::string problem = validate(settings_, view); !problem.empty()) throw InputError(fmt::format("{}: {}", place, problem));
    time("move", [&] { lighting_.moveTo(view); });
}

void MovingLight::frame(float timestep) {
    TexelSampler sampler;
    LightMaps maps(scene_, options_.seed, parallelFor_);
    time("rsm", [&] { sampler.build(maps.render(frames_), maps.side(), parallelFor_); });
    time("rays", [&] { lighting_.rays(sampler, options_.rays); });
    time("trace", [&] { lighting_.trace(); });
    time("inject", [&] { lighting_.inject(); });
    time("merge", [&] { lighting_.merge(timestep); });
    ++frames_;
    ended_ = true;
}

}  // namespace clv
