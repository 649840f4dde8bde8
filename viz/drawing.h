// What a view comes down to: coloured shapes and words, ready for any renderer.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "viz/color_scale.h"
#include "viz/cube_actors.h"
#include "viz/flat_actors.h"
#include "viz/plot.h"
#include "viz/view.h"

namespace clv {

// Values on the cells of a grid, for volume rendering; not a number where nothing is shown.
struct GridValues {
    ClvVolume grid{};
    std::vector<float> values;
};

struct Drawing {
    std::vector<LitCube> cubes;
    FlatQuads tiles;                  // of slices
    std::vector<GridValues> grids;    // a cascade each
    FlatTriangles mesh;
    FlatLines lines, thickLines;
    FlatLines signs{.points = {}, .colors = {}, .inFront = true};  // seen through all else: lights, cameras, where a plot is taken
    FlatPoints points;
    std::optional<ColorScale> scale;  // of the bar
    std::optional<Exposure> exposure; // of radiance
    std::optional<Plot> plot;
    std::string caption;              // one line
};

}  // namespace clv
