// Cells by path tracing, and how far they are from it.
#pragma once
#include "viz/cell_values.h"
#include "viz/world.h"

namespace clv {

// So many cells at most are path traced for a view; of more, one in each block of cells is.
inline constexpr std::size_t kMostMeasured = 3000;

// The errors of the sides in colours, on cells, slices or as a volume: |E - T| / max(|T|, 0.05 mean |T|), of a cell the mean of its sides.
void drawCellErrors(const BakedVolume& volume, const World& world, const View& view, const ParallelFor& parallelFor, Drawing& drawing);

// Ambient cubes, or the irradiance, as path tracing has it.
void drawCellTruth(const BakedVolume& volume, const World& world, const View& view, const ParallelFor& parallelFor, Drawing& drawing);

}  // namespace clv
