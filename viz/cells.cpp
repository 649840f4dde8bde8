#include "viz/cells.h"

#include <algorithm>
#include <cmath>

#include "bindings/image/tone_map.h"

namespace clv {
namespace {

constexpr double kWorstNoise = 100.0;  // %

float noiseOf(const CellLight& light, std::size_t firstSide, std::size_t endSide) {
    double variance = 0.0, square = 0.0;
    for (std::size_t side = firstSide; side < endSide; ++side) {
        const glm::dvec3 irradiance(light.irradiance[side]);
        variance += double(light.variance[side]);
        square += dot(irradiance, irradiance) / 3.0;
    }
    return square > 0.0 ? float(std::min(kWorstNoise, 100.0 * std::sqrt(variance / square))) : float(kWorstNoise);
}

}  // namespace

float brightest(const CellLight& light) {
    float most = 0.0f;
    for (const vec3& e : light.irradiance) most = std::max({most, e.x, e.y, e.z});
    return most;
}

std::string nameOf(Quantity quantity) {
    static constexpr const char* kNames[kQuantities] = {"irradiance", "dynamicity", "samples", "variance", "open", "noise"};
    return kNames[int(quantity)];
}

std::string titleOf(Quantity quantity) {
    static constexpr const char* kTitles[kQuantities] = {"irradiance, W/m^2", "dynamicity", "samples, rays", "variance, (W/m^2)^2",
                                                         "open share of the cell", "relative standard error, %"};
    return kTitles[int(quantity)];
}

bool knowsVariance(const BakedVolume& volume) { return volume.cascades.front().estimates.size() > 1; }

bool knows(const BakedVolume& volume, Quantity quantity) {
    return knowsVariance(volume) || (quantity != Quantity::variance && quantity != Quantity::noise);
}

std::optional<ShownCell> shownCell(const BakedVolume& volume, uint cascade, const ivec3& cell, ShownCascade only) {
    const BakedCascade& baked = volume.cascades[cascade];
    const ClvVolume& grid = baked.level.volume;
    const uint index = clvCellIndex(grid, cell);
    if (baked.level.table[index] == kClvNoSlot) return {};
    ShownCell shown{cascade, cell, clvCellCenter(grid, cell), grid.cellSize, {}};
    if (only ? cascade != *only : clvCascadeFromPosition(cascadesOf(volume), shown.center) != cascade) return {};
    shown.light = cellLight(volume, baked, index);
    return shown;
}

std::vector<ShownCell> shownCells(const BakedVolume& volume, ShownCascade only, const ParallelFor& parallelFor, float threshold) {
    std::vector<ShownCell> all;
    for (uint cascade = 0; cascade < volume.cascades.size(); ++cascade) {
        const ivec3 resolution = volume.cascades[cascade].level.volume.resolution;
        std::vector<std::vector<ShownCell>> slices(std::size_t(resolution.z));
        parallelFor(slices.size(), [&](std::size_t z) {
            for (int y = 0; y < resolution.y; ++y) {
                for (int x = 0; x < resolution.x; ++x) {
                    const auto shown = shownCell(volume, cascade, ivec3(x, y, int(z)), only);
                    if (shown && brightest(shown->light) >= threshold) slices[z].push_back(*shown);
                }
            }
        });
        for (const auto& slice : slices) all.insert(all.end(), slice.begin(), slice.end());
    }
    return all;
}

std::optional<ShownCell> cellAt(const BakedVolume& volume, const vec3& position, ShownCascade only) {
    for (uint cascade = 0; cascade < volume.cascades.size(); ++cascade) {
        const ClvVolume& grid = volume.cascades[cascade].level.volume;
        const ivec3 cell = clvCellFromPosition(grid, position);
        if (!clvCellInside(grid, cell)) continue;
        if (const auto shown = shownCell(volume, cascade, cell, only)) return shown;
    }
    return {};
}

float valueOf(const ShownCell& cell, Quantity quantity, std::size_t side) {
    switch (quantity) {
        case Quantity::irradiance: return luminance(cell.light.irradiance[side]);
        case Quantity::dynamicity: return cell.light.dynamicity[side];
        case Quantity::variance: return cell.light.variance[side];
        case Quantity::samples: return cell.light.samples;
        case Quantity::noise: return noiseOf(cell.light, side, side + 1);
        case Quantity::open: return cell.light.openVolume / (cell.edge * cell.edge * cell.edge);
    }
    return 0.0f;
}

float valueOf(const ShownCell& cell, Quantity quantity) {
    if (quantity == Quantity::noise) return noiseOf(cell.light, 0, kSides);
    float sum = 0.0f, most = 0.0f;
    for (std::size_t side = 0; side < kSides; ++side) {
        sum += valueOf(cell, quantity, side);
        most = std::max(most, valueOf(cell, quantity, side));
    }
    return quantity == Quantity::dynamicity ? most : sum / float(kSides);
}

}  // namespace clv
