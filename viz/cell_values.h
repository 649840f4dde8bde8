// Values of cells, drawn on cells, slices or as a volume.
#pragma once
#include <functional>
#include <vector>

#include "clv/cpu/parallel.h"
#include "viz/cells.h"
#include "viz/drawing.h"

namespace clv {

// What is shown of a cell, of one side and of the whole; not a number where nothing is known.
struct CellValues {
    std::function<float(const ShownCell&, std::size_t side)> ofSide;
    std::function<float(const ShownCell&)> ofCell;
};

std::vector<float> valuesOfSides(const std::vector<ShownCell>& cells, const CellValues& values);

// The cells that a plane cuts; where cells of several cascades do, each place is shown by one of them.
std::vector<ShownCell> cellsCutBy(const BakedVolume& volume, const SlicePlane& plane, ShownCascade only);

// The cells that a view shows: those of its cubes, on its slices, or all.
std::vector<ShownCell> cellsOf(const BakedVolume& volume, const View& view, const ParallelFor& parallelFor);
// Of cells that may be drawn as cubes: erases those below the view's threshold.
void leaveOutDim(const View& view, std::vector<ShownCell>& cells);

LitCube cubeOf(const ShownCell& cell);
// Cubes that are too many are merged.
void addCubes(std::vector<LitCube> cubes, Drawing& drawing);

// Draws the cells in the colours of drawing.scale, on what the view says; `cells` are those that are drawn as cubes.
void drawValues(const BakedVolume& volume, const std::vector<ShownCell>& cells, const CellValues& values, const View& view, Drawing& drawing);

}  // namespace clv
