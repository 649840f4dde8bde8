#include "bindings/cli/bake_grids.h"

#include <algorithm>

#include "bindings/cli/camera_view.h"
#include "bindings/cli/options.h"
#include "bindings/cli/scene_facts.h"
#include "clv/cpu/moving_lighting.h"

namespace clv {

void addCascadeOptions(CLI::App& command, CascadeOptions& options) {
    auto* count = command.add_option("--cascades", options.count, "Nested grids of N^3 cells around a camera, each twice as wide as the one inside it; default: one grid over the scene")
                      ->check(CLI::Range(1, int(kClvMaxCascades)));
    command.add_option("--camera", options.camera, "Camera that the cascades stand around, by name or index")->needs(count)->capture_default_str();
    addPositiveOption(command, "--cell-size", options.cellSize, "Side of the finest cascade's cells, m; default: so that the coarsest cascade holds the scene")->needs(count);
    command.get_option("--cell-shift")->excludes(count);
}

BakeGrids bakeGrids(const Scene& scene, const LightOptions& light, const CascadeOptions& options) {
    if (options.count == 0) return {.grids = {volumeOver(scene, light.resolution, light)}, .camera = {}};
    const Camera& camera = chooseCamera(scene, options.camera);
    CascadeDesc desc{.count = options.count, .resolution = ivec3(light.resolution), .finestCellSize = options.cellSize};
    if (options.cellSize == 0.0) {
        desc.finestCellSize = 1.0;
        const glm::vec3 farthest = glm::max(glm::abs(scene.bounds.lo - camera.position), glm::abs(scene.bounds.hi - camera.position));
        desc.finestCellSize = double(std::max({farthest.x, farthest.y, farthest.z})) / heldRadius(desc, desc.count - 1);
    }
    const CameraView view{.position = scene.anchor + glm::dvec3(camera.position), .forward = glm::normalize(glm::dvec3(camera.forward)), .yfov = camera.yfov, .aspect = camera.aspect};
    if (const std::string problem = validate(desc, view); !problem.empty()) throw InputError("--cascades: " + problem);

    BakeGrids baked{.grids = {}, .camera = camera, .marginCells = float(desc.marginCells), .blendCells = MovingLightingSettings{}.blendCells};
    for (int level = 0; level < desc.count; ++level) {
        ClvVolume grid = volumeFromCascade(placeCascade(desc, view, level), scene.anchor, light.storage);
        grid.scroll = ivec3(0);  // it never moves, so its cells may lie in memory as they lie in space
        baked.grids.push_back(grid);
    }
    return baked;
}

}  // namespace clv
