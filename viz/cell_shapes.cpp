#include "viz/cell_shapes.h"

#include <cmath>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include "clv/math/constants.h"

namespace clv {
namespace {

constexpr std::size_t kMostCubes = 300000;  // that are drawn; more are merged

// What is shown of a cell, of one side and of the whole.
struct CellValues {
    std::function<float(const ShownCell&, std::size_t side)> ofSide;
    std::function<float(const ShownCell&)> ofCell;
};

void addCubes(std::vector<LitCube> cubes, Drawing& drawing) {
    int merged = 1;
    for (; cubes.size() > kMostCubes; merged *= 2) cubes = mergedCubes(cubes);
    if (merged > 1) drawing.caption += fmt::format(", {0} x {0} x {0} cells a cube", merged);
    drawing.cubes = std::move(cubes);
}

LitCube cubeOf(const ShownCell& cell) {
    return {cell.center, kCubeShare * cell.edge, cell.edge, {}};
}

// The cells that a plane cuts; where cells of several cascades do, each place is shown by one of them.
void addTiles(const BakedVolume& volume, const CellValues& values, const View& view, const SlicePlane& plane, const ColorScale& scale, FlatQuads& tiles) {
    const int axis = plane.axis, u = (axis + 1) % 3, v = (axis + 2) % 3;
    const float place = float(plane.place - volume.anchor[axis]);
    for (uint cascade = 0; cascade < volume.cascades.size(); ++cascade) {
        const ClvVolume& grid = volume.cascades[cascade].level.volume;
        ivec3 cell(0);
        cell[axis] = int(std::floor((place - grid.origin[axis]) / grid.cellSize));
        if (cell[axis] < 0 || cell[axis] >= grid.resolution[axis]) continue;
        for (cell[v] = 0; cell[v] < grid.resolution[v]; ++cell[v]) {
            for (cell[u] = 0; cell[u] < grid.resolution[u]; ++cell[u]) {
                const auto shown = shownCell(volume, cascade, cell, view.filter);
                if (!shown) continue;
                static constexpr float kCorner[4][2] = {{-0.5f, -0.5f}, {0.5f, -0.5f}, {0.5f, 0.5f}, {-0.5f, 0.5f}};
                for (const float* corner : kCorner) {
                    vec3 p = shown->center;
                    p[axis] = place, p[u] += corner[0] * shown->edge, p[v] += corner[1] * shown->edge;
                    tiles.points.push_back(p);
                }
                tiles.colors.push_back(scale.color(values.ofCell(*shown)));
            }
        }
    }
}

GridValues gridOf(const BakedVolume& volume, uint cascade, const CellValues& values, const CellFilter& filter) {
    GridValues grid{volume.cascades[cascade].level.volume, {}};
    grid.values.resize(volume.cascades[cascade].level.cellCount(), std::numeric_limits<float>::quiet_NaN());
    for (uint i = 0; i < grid.values.size(); ++i) {
        if (const auto shown = shownCell(volume, cascade, clvCellFromIndex(grid.grid, i), filter)) grid.values[i] = values.ofCell(*shown);
    }
    return grid;
}

// Draws the cells in the colours of drawing.scale.
void drawValues(const BakedVolume& volume, const std::vector<ShownCell>& cells, const CellValues& values, const View& view, Drawing& drawing) {
    if (view.carrier == Carrier::slices) {
        drawing.tiles.oneSided = false;
        for (const SlicePlane& plane : view.slices) addTiles(volume, values, view, plane, *drawing.scale, drawing.tiles);
    } else if (view.carrier == Carrier::volume) {
        for (uint cascade = 0; cascade < volume.cascades.size(); ++cascade) drawing.grids.push_back(gridOf(volume, cascade, values, view.filter));
    } else {
        std::vector<LitCube> cubes;
        for (const ShownCell& cell : cells) {
            LitCube& cube = cubes.emplace_back(cubeOf(cell));
            for (std::size_t side = 0; side < kSides; ++side) cube.side[side] = drawing.scale->color(values.ofSide(cell, side));
        }
        addCubes(std::move(cubes), drawing);
    }
}

std::vector<float> valuesOfSides(const std::vector<ShownCell>& cells, const CellValues& values) {
    std::vector<float> all;
    for (const ShownCell& cell : cells) {
        for (std::size_t side = 0; side < kSides; ++side) all.push_back(values.ofSide(cell, side));
    }
    return all;
}

void checkSameGrids(const BakedVolume& a, const BakedVolume& b) {
    bool same = a.cascades.size() == b.cascades.size() && a.anchor == b.anchor;
    for (std::size_t i = 0; same && i < a.cascades.size(); ++i) {
        const ClvVolume &g = a.cascades[i].level.volume, &h = b.cascades[i].level.volume;
        same = g.origin == h.origin && g.cellSize == h.cellSize && g.resolution == h.resolution;
    }
    if (!same) throw InputError("--difference: expected two volumes with the same cells: bake both with the same scene, resolution and cell shift");
}

}  // namespace

void drawCubes(const BakedVolume& volume, const View& view, const ParallelFor& parallelFor, Drawing& drawing) {
    drawing.caption = "ambient cubes: irradiance on the six sides, as radiance of white surfaces";
    const std::vector<ShownCell> cells = shownCells(volume, view.filter, parallelFor);
    std::vector<vec3> radiance;
    for (const ShownCell& cell : cells) {
        for (const vec3& e : cell.light.irradiance) radiance.push_back(e / kClvPi);
    }
    const Exposure exposure = exposureFor(radiance, view.exposure);
    std::vector<LitCube> cubes;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        LitCube& cube = cubes.emplace_back(cubeOf(cells[i]));
        for (std::size_t side = 0; side < kSides; ++side) cube.side[side] = screenColor(radiance[i * kSides + side], exposure);
    }
    addCubes(std::move(cubes), drawing);
}

void drawQuantity(const BakedVolume& volume, Quantity quantity, const View& view, const ParallelFor& parallelFor, Drawing& drawing) {
    drawing.caption = titleOf(quantity);
    const std::vector<ShownCell> cells = shownCells(volume, view.filter, parallelFor);
    const CellValues values{[quantity](const ShownCell& cell, std::size_t side) { return valueOf(cell, quantity, side); },
                            [quantity](const ShownCell& cell) { return valueOf(cell, quantity); }};
    drawing.scale = scaleFor(titleOf(quantity), valuesOfSides(cells, values));
    if (view.range) drawing.scale->lo = view.range->x, drawing.scale->hi = view.range->y;
    drawValues(volume, cells, values, view, drawing);
}

void drawDifference(const BakedVolume& volume, const BakedVolume& other, Quantity quantity, const View& view, const ParallelFor& parallelFor, Drawing& drawing) {
    checkSameGrids(volume, other);
    drawing.caption = "difference, left minus right file: " + titleOf(quantity);
    const std::vector<ShownCell> cells = shownCells(volume, view.filter, parallelFor);
    const auto there = [&other](ShownCell cell) {
        const BakedCascade& baked = other.cascades[cell.cascade];
        cell.light = cellLight(other, baked, clvCellIndex(baked.level.volume, cell.cell));
        return cell;
    };
    const CellValues values{[=](const ShownCell& cell, std::size_t side) { return valueOf(cell, quantity, side) - valueOf(there(cell), quantity, side); },
                            [=](const ShownCell& cell) { return valueOf(cell, quantity) - valueOf(there(cell), quantity); }};
    drawing.scale = differenceScaleFor(titleOf(quantity), valuesOfSides(cells, values));
    if (view.range) drawing.scale->lo = view.range->x, drawing.scale->hi = view.range->y;
    drawValues(volume, cells, values, view, drawing);
}

}  // namespace clv
