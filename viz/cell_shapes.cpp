#include "viz/cell_shapes.h"

#include <algorithm>

#include "clv/math/constants.h"
#include "viz/cell_values.h"

namespace clv {
namespace {

constexpr std::size_t kPiece = 1024;  // cells
constexpr const char* kUnknown = ": unknown from a single estimate of the light";

void checkSameGrids(const BakedVolume& a, const BakedVolume& b) {
    bool same = a.cascades.size() == b.cascades.size() && a.anchor == b.anchor;
    for (std::size_t i = 0; same && i < a.cascades.size(); ++i) {
        const ClvVolume &g = a.cascades[i].level.volume, &h = b.cascades[i].level.volume;
        same = g.origin == h.origin && g.cellSize == h.cellSize && g.resolution == h.resolution;
    }
    if (!same) throw InputError("--difference: expected two volumes with the same cells: bake both with the same scene, resolution and cell shift");
}

}  // namespace

void drawCubes(const std::vector<ShownCell>& cells, const View& view, const ParallelFor& parallelFor, Drawing& drawing) {
    drawing.caption = "ambient cubes: irradiance on six sides";
    std::vector<vec3> radiance;
    radiance.reserve(cells.size() * kSides);
    for (const ShownCell& cell : cells) {
        for (const vec3& e : cell.light.irradiance) radiance.push_back(e / kClvPi);
    }
    const Exposure exposure = view.fixedExposure.value_or(exposureFor(radiance, view.exposure));
    drawing.exposure = exposure;
    std::vector<LitCube> cubes(cells.size());
    parallelFor((cells.size() + kPiece - 1) / kPiece, [&](std::size_t piece) {
        for (std::size_t i = piece * kPiece; i < std::min(cells.size(), (piece + 1) * kPiece); ++i) {
            cubes[i] = cubeOf(cells[i]);
            for (std::size_t side = 0; side < kSides; ++side) cubes[i].side[side] = screenColor(radiance[i * kSides + side], exposure);
        }
    });
    addCubes(std::move(cubes), drawing);
}

void drawQuantity(const BakedVolume& volume, Quantity quantity, const View& view, const ParallelFor& parallelFor, Drawing& drawing) {
    drawing.caption = titleOf(quantity);
    if (!knows(volume, quantity)) {
        drawing.caption += kUnknown;
        return;
    }
    if (volume.allBounces && (quantity == Quantity::variance || quantity == Quantity::noise)) drawing.caption += ", without that of further bounces";
    if (quantity == Quantity::dynamicity && volume.cascades.front().dynamicity.empty()) drawing.caption += ": none, no light moves in this volume";
    std::vector<ShownCell> cells = shownCells(volume, view.cascade, parallelFor);
    const CellValues values{[quantity](const ShownCell& cell, std::size_t side) { return valueOf(cell, quantity, side); },
                            [quantity](const ShownCell& cell) { return valueOf(cell, quantity); }};
    drawing.scale = scaleFor(titleOf(quantity), valuesOfSides(cells, values));
    if (view.range) drawing.scale->lo = view.range->x, drawing.scale->hi = view.range->y;
    leaveOutDim(view, cells);
    drawValues(volume, cells, values, view, drawing);
}

void drawDifference(const BakedVolume& volume, const BakedVolume& other, Quantity quantity, const View& view, const ParallelFor& parallelFor, Drawing& drawing) {
    checkSameGrids(volume, other);
    drawing.caption = "difference, left minus right file: " + titleOf(quantity);
    if (!knows(volume, quantity) || !knows(other, quantity)) {
        drawing.caption += kUnknown;
        return;
    }
    std::vector<ShownCell> cells = shownCells(volume, view.cascade, parallelFor);
    const auto there = [&other](ShownCell cell) {
        const BakedCascade& baked = other.cascades[cell.cascade];
        cell.light = cellLight(other, baked, clvCellIndex(baked.level.volume, cell.cell));
        return cell;
    };
    const CellValues values{[=](const ShownCell& cell, std::size_t side) { return valueOf(cell, quantity, side) - valueOf(there(cell), quantity, side); },
                            [=](const ShownCell& cell) { return valueOf(cell, quantity) - valueOf(there(cell), quantity); }};
    drawing.scale = differenceScaleFor(titleOf(quantity), valuesOfSides(cells, values));
    if (view.range) drawing.scale->lo = view.range->x, drawing.scale->hi = view.range->y;
    // What one file has and the other lacks is where they differ most.
    std::erase_if(cells, [&](const ShownCell& cell) { return std::max(brightest(cell.light), brightest(there(cell).light)) < view.threshold; });
    drawValues(volume, cells, values, view, drawing);
}

}  // namespace clv
