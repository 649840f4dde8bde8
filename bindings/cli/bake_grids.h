// Where the grids of a baked volume stand.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "bindings/cli/light_options.h"
#include "bindings/scene/scene.h"
#include "clv/data/cascades.h"

namespace clv {

struct CascadeOptions {
    int count = 0;             // around a camera; 0: one grid over the scene
    std::string camera = "0";  // name or index
    double cellSize = 0.0;     // m, of the finest cascade; 0: so that the coarsest one holds the scene
};
void addCascadeOptions(CLI::App& command, CascadeOptions& options);

struct BakeGrids {
    std::vector<ClvVolume> grids;  // finest first
    std::optional<Camera> camera;
    float marginCells = 0.0f, blendCells = 0.0f;  // see ClvCascades
};
// Throws InputError.
BakeGrids bakeGrids(const Scene& scene, const LightOptions& light, const CascadeOptions& options);

}  // namespace clv
