// Cells as shapes: ambient cubes, cubes that show a quantity, slices, grids.
#pragma once
#include "clv/cpu/parallel.h"
#include "viz/drawing.h"

namespace clv {

// Cubes whose faces are lit by what arrives on them, radiance of white surfaces, for these cells.
void drawCubes(const std::vector<ShownCell>& cells, const View& view, const ParallelFor& parallelFor, Drawing& drawing);
// The quantity in colours, on what the view says.
void drawQuantity(const BakedVolume& volume, Quantity quantity, const View& view, const ParallelFor& parallelFor, Drawing& drawing);

// The same for how much more of it `volume` has than `other`. Throws InputError unless both have the same grids.
void drawDifference(const BakedVolume& volume, const BakedVolume& other, Quantity quantity, const View& view, const ParallelFor& parallelFor, Drawing& drawing);

}  // namespace clv
