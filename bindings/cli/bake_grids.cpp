#include "bindings/cli/bake_grids.h"

#include "bindings/cli/camera_view.h"
#include "bindings/cli/moving_light.h"
#include "bindings/cli/options.h"
#include "bindings/cli/scene_facts.h"

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
    const CascadeDesc desc = cascadesAround(scene, camera, options.count, light.resolution, options.cellSize);
    const CameraView view = viewOf(scene, camera);
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
