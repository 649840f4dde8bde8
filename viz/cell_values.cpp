#include "viz/cell_values.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace clv {
namespace {

constexpr std::size_t kMostCubes = 300000;  // that are drawn; more are merged

void addTiles(const BakedVolume& volume, const CellValues& values, const View& view, const SlicePlane& plane, const ColorScale& scale, FlatQuads& tiles) {
    const int axis = plane.axis, u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const ShownCell& cell : cellsCutBy(volume, plane, view.cascade)) {
        const float value = values.ofCell(cell);
        if (!std::isfinite(value)) continue;
        static constexpr float kCorner[4][2] = {{-0.5f, -0.5f}, {0.5f, -0.5f}, {0.5f, 0.5f}, {-0.5f, 0.5f}};
        for (const float* corner : kCorner) {
            vec3 p = cell.center;
            p[axis] = float(plane.place - volume.anchor[axis]), p[u] += corner[0] * cell.edge, p[v] += corner[1] * cell.edge;
            tiles.points.push_back(p);
        }
        tiles.colors.push_back(scale.color(value));
    }
}

GridValues gridOf(const BakedVolume& volume, uint cascade, const CellValues& values, ShownCascade only) {
    GridValues grid{volume.cascades[cascade].level.volume, {}};
    grid.values.resize(volume.cascades[cascade].level.cellCount(), std::numeric_limits<float>::quiet_NaN());
    for (uint i = 0; i < grid.values.size(); ++i) {
        if (const auto shown = shownCell(volume, cascade, clvCellFromIndex(grid.grid, i), only)) grid.values[i] = values.ofCell(*shown);
    }
    return grid;
}

}  // namespace

std::vector<float> valuesOfSides(const std::vector<ShownCell>& cells, const CellValues& values) {
    std::vector<float> all;
    for (const ShownCell& cell : cells) {
        for (std::size_t side = 0; side < kSides; ++side) all.push_back(values.ofSide(cell, side));
    }
    return all;
}

std::vector<ShownCell> cellsCutBy(const BakedVolume& volume, const SlicePlane& plane, ShownCascade only) {
    const int axis = plane.axis, u = (axis + 1) % 3, v = (axis + 2) % 3;
    const float place = float(plane.place - volume.anchor[axis]);
    std::vector<ShownCell> cells;
    for (uint cascade = 0; cascade < volume.cascades.size(); ++cascade) {
        const ClvVolume& grid = volume.cascades[cascade].level.volume;
        ivec3 cell(0);
        cell[axis] = int(std::floor((place - grid.origin[axis]) / grid.cellSize));
        if (cell[axis] < 0 || cell[axis] >= grid.resolution[axis]) continue;
        for (cell[v] = 0; cell[v] < grid.resolution[v]; ++cell[v]) {
            for (cell[u] = 0; cell[u] < grid.resolution[u]; ++cell[u]) {
                if (const auto shown = shownCell(volume, cascade, cell, only)) cells.push_back(*shown);
            }
        }
    }
    return cells;
}

std::vector<ShownCell> cellsOf(const BakedVolume& volume, const View& view, const ParallelFor& parallelFor) {
    if (showsCubes(view) || carrierOf(view) != Carrier::slices) return shownCells(volume, view.cascade, parallelFor, showsCubes(view) ? view.threshold : 0.0f);
    std::vector<ShownCell> cells;
    for (const SlicePlane& plane : view.slices) {
        const std::vector<ShownCell> cut = cellsCutBy(volume, plane, view.cascade);
        cells.insert(cells.end(), cut.begin(), cut.end());
    }
    return cells;
}

void leaveOutDim(const View& view, std::vector<ShownCell>& cells) {
    std::erase_if(cells, [least = view.threshold](const ShownCell& cell) { return brightest(cell.light) < least; });
}

LitCube cubeOf(const ShownCell& cell) {
    return {cell.center, kCubeShare * cell.edge, cell.edge, {}};
}

void addCubes(std::vector<LitCube> cubes, Drawing& drawing) {
    int merged = 1;
    for (; cubes.size() > kMostCubes; merged *= 2) cubes = mergedCubes(cubes);
    if (merged > 1) drawing.caption += fmt::format(", {0} x {0} x {0} cells a cube", merged);
    drawing.cubes = std::move(cubes);
}

void drawValues(const BakedVolume& volume, const std::vector<ShownCell>& cells, const CellValues& values, const View& view, Drawing& drawing) {
    const Carrier carrier = carrierOf(view);
    if (carrier == Carrier::slices) {
        drawing.tiles.oneSided = false;
        for (const SlicePlane& plane : view.slices) addTiles(volume, values, view, plane, *drawing.scale, drawing.tiles);
    } else if (carrier == Carrier::volume) {
        for (uint cascade = 0; cascade < volume.cascades.size(); ++cascade) drawing.grids.push_back(gridOf(volume, cascade, values, view.cascade));
    } else {
        std::vector<LitCube> cubes;
        for (const ShownCell& cell : cells) {
            LitCube& cube = cubes.emplace_back(cubeOf(cell));
            for (std::size_t side = 0; side < kSides; ++side) cube.side[side] = drawing.scale->color(values.ofSide(cell, side));
        }
        addCubes(std::move(cubes), drawing);
    }
}

}  // namespace clv
