#include "viz/cell_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "benchmarks/report/metrics.h"
#include "viz/cell_shapes.h"
#include "viz/truth_error.h"

namespace clv {
namespace {

using SideValues = std::array<float, kSides>;

// Cells in blocks of `edge` cells each way, one of each measured.
struct Blocks {
    int edge = 1;
    std::vector<ShownCell> measured;

    using Key = std::tuple<uint, int, int, int>;
    Key keyOf(const ShownCell& cell) const { return {cell.cascade, cell.cell.x / edge, cell.cell.y / edge, cell.cell.z / edge}; }

    // The smallest blocks of which there are few enough.
    explicit Blocks(const std::vector<ShownCell>& cells) {
        for (;; ++edge) {
            std::map<Key, const ShownCell*> first;
            for (const ShownCell& cell : cells) first.emplace(keyOf(cell), &cell);
            if (first.size() > kMostMeasured) continue;
            for (const auto& [key, cell] : first) measured.push_back(*cell);
            return;
        }
    }
};

float meanOf(const SideValues& sides) {
    float sum = 0.0f;
    for (const float value : sides) sum += value;
    return sum / float(kSides);
}

// Values of the measured cells, each of which stands for its block.
struct Measured {
    explicit Measured(const Blocks& of) : blocks(of) {}

    const Blocks& blocks;
    std::vector<ShownCell> cells;  // whose values are known
    std::map<Blocks::Key, SideValues> sides;

    void add(std::size_t index, std::span<const float, kSides> values) {
        const ShownCell& cell = blocks.measured[index];
        std::ranges::copy(values, sides[blocks.keyOf(cell)].begin());
        cells.push_back(cell);
        // Drawn as large as what it stands for.
        const ivec3 first = cell.cell / blocks.edge * blocks.edge;
        cells.back().center += cell.edge * (vec3(first - cell.cell) + 0.5f * float(blocks.edge - 1));
        cells.back().edge *= float(blocks.edge);
    }
    // Valid as long as this is.
    CellValues values() const {
        return {[this](const ShownCell& cell, std::size_t side) { return of(cell)[side]; }, [this](const ShownCell& cell) { return meanOf(of(cell)); }};
    }

private:
    SideValues of(const ShownCell& cell) const {
        const auto found = sides.find(blocks.keyOf(cell));
        if (found != sides.end()) return found->second;
        SideValues none;
        none.fill(std::numeric_limits<float>::quiet_NaN());
        return none;
    }
};

std::vector<std::optional<SideTruth>> truthOf(const Blocks& blocks, const BakedVolume& volume, const World& world, const View& view, const ParallelFor& parallelFor) {
    return world.cellTruth().of(blocks.measured, world.embree(), {.allBounces = volume.allBounces, .samples = view.errorSamples}, parallelFor);
}

void sayBlocks(const Blocks& blocks, Drawing& drawing) {
    if (blocks.edge > 1) drawing.caption += fmt::format("; one cell in {0} x {0} x {0}", blocks.edge);
}

}  // namespace

void drawCellErrors(const BakedVolume& volume, const World& world, const View& view, const ParallelFor& parallelFor, Drawing& drawing) {
    const Blocks blocks(cellsOf(volume, view, parallelFor));
    const auto truth = truthOf(blocks, volume, world, view, parallelFor);
    std::vector<vec3> estimates, truths;
    std::vector<float> standardErrors;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        for (std::size_t side = 0; truth[i] && side < kSides; ++side) {
            estimates.push_back(blocks.measured[i].light.irradiance[side]);
            truths.push_back(truth[i]->irradiance[side]);
            standardErrors.push_back(truth[i]->standardError[side]);
        }
    }
    const std::vector<float> errors = pointErrors(estimates, truths);
    Measured measured(blocks);
    for (std::size_t i = 0; i < truth.size(); ++i) {
        if (truth[i]) measured.add(i, std::span(errors).subspan(kSides * measured.cells.size()).first<kSides>());
    }
    drawing.caption = fmt::format("error of the cells' sides against path tracing, itself known to {:.1f} %", 100.0 * medianError(standardErrors, truths));
    sayBlocks(blocks, drawing);
    drawing.scale = scaleFor("error / truth", errors);
    if (view.range) drawing.scale->lo = view.range->x, drawing.scale->hi = view.range->y;
    drawValues(volume, measured.cells, measured.values(), view, drawing);
}

void drawCellTruth(const BakedVolume& volume, const World& world, const View& view, const ParallelFor& parallelFor, Drawing& drawing) {
    Blocks blocks(cellsOf(volume, view, parallelFor));
    const auto truth = truthOf(blocks, volume, world, view, parallelFor);
    Measured measured(blocks);
    for (std::size_t i = 0; i < truth.size(); ++i) {
        if (!truth[i]) continue;
        blocks.measured[i].light.irradiance = truth[i]->irradiance;
        SideValues sides;
        for (std::size_t side = 0; side < kSides; ++side) sides[side] = valueOf(blocks.measured[i], Quantity::irradiance, side);
        measured.add(i, sides);
    }
    if (view.subject == Subject::cubes) {
        drawCubes(measured.cells, view, parallelFor, drawing);
    } else {
        drawing.caption = titleOf(Quantity::irradiance);
        drawing.scale = scaleFor(titleOf(Quantity::irradiance), valuesOfSides(measured.cells, measured.values()));
        if (view.range) drawing.scale->lo = view.range->x, drawing.scale->hi = view.range->y;
        drawValues(volume, measured.cells, measured.values(), view, drawing);
    }
    drawing.caption = "path tracing: " + drawing.caption;
    sayBlocks(blocks, drawing);
}

}  // namespace clv
