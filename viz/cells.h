// The cells of a volume that a view shows, and what it shows of them.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "bindings/volume_file/baked_volume.h"
#include "clv/cpu/parallel.h"

namespace clv {

enum class Quantity { irradiance, dynamicity, samples, variance, open, noise };
inline constexpr int kQuantities = 6;

// Name on the command line.
std::string nameOf(Quantity quantity);
// With the unit.
std::string titleOf(Quantity quantity);

// A single estimate says nothing of its variance.
bool knowsVariance(const BakedVolume& volume);
bool knows(const BakedVolume& volume, Quantity quantity);

// One cascade alone, or none: each place is shown by the finest cascade that holds it.
using ShownCascade = std::optional<uint>;

struct ShownCell {
    uint cascade;
    ivec3 cell;
    vec3 center;   // m
    float edge;    // m
    CellLight light;
};

// What a view shows of a cell: of one that is open, however dark; nothing of a solid one, or where another cascade is shown.
std::optional<ShownCell> shownCell(const BakedVolume& volume, uint cascade, const ivec3& cell, ShownCascade only);
// All of them, cascade by cascade, x fastest; not those of which no side receives as much as `threshold`, W/m^2.
std::vector<ShownCell> shownCells(const BakedVolume& volume, ShownCascade only, const ParallelFor& parallelFor, float threshold = 0.0f);

// The shown cell that holds a position, m; of several cascades the finest that shows one.
std::optional<ShownCell> cellAt(const BakedVolume& volume, const vec3& position, ShownCascade only);

// W/m^2, of the side and channel that receives most.
float brightest(const CellLight& light);

// Of a cell's edge that the cube takes which stands for it.
inline constexpr float kCubeShare = 0.7f;

// On one side. Irradiance is its luminance. Noise is the standard error over the irradiance, %, each the root of a mean square over the
// channels: 100 where one half of the rays found no light, and where neither did.
float valueOf(const ShownCell& cell, Quantity quantity, std::size_t side);
// Of the whole cell: the mean of its sides; of dynamicity the largest; of noise that of all sides together.
float valueOf(const ShownCell& cell, Quantity quantity);

}  // namespace clv
