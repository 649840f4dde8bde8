// The cells of a volume that a view shows, and what it shows of them.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "bindings/volume_file/baked_volume.h"
#include "clv/cpu/parallel.h"

namespace clv {

enum class Quantity { irradiance, dynamicity, samples, variance, open };
inline constexpr int kQuantities = 5;

// Name on the command line.
std::string nameOf(Quantity quantity);
// With the unit.
std::string titleOf(Quantity quantity);

// A single estimate says nothing of its variance.
bool knowsVariance(const BakedVolume& volume);

struct CellFilter {
    std::optional<uint> cascade;  // none: each place is shown by the finest cascade that holds it
    float threshold = 0.0f;       // W/m^2: cells none of whose sides receives more are left out
};

struct ShownCell {
    uint cascade;
    ivec3 cell;
    vec3 center;   // m
    float edge;    // m
    CellLight light;
};

// What a view shows of a cell that the filter lets through; nothing of a cell that it does not.
std::optional<ShownCell> shownCell(const BakedVolume& volume, uint cascade, const ivec3& cell, const CellFilter& filter);
// All of them, cascade by cascade, x fastest.
std::vector<ShownCell> shownCells(const BakedVolume& volume, const CellFilter& filter, const ParallelFor& parallelFor);

// The shown cell that holds a position, m; of several cascades the finest that shows one.
std::optional<ShownCell> cellAt(const BakedVolume& volume, const vec3& position, const CellFilter& filter);

// Of a cell's edge that the cube takes which stands for it.
inline constexpr float kCubeShare = 0.7f;

// On one side. Irradiance is its luminance.
float valueOf(const ShownCell& cell, Quantity quantity, std::size_t side);
// Of the whole cell: the mean of its sides; for dynamicity the largest.
float valueOf(const ShownCell& cell, Quantity quantity);

}  // namespace clv
