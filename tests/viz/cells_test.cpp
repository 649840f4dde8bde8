// Which cells a view shows, and what their numbers are.
#include <gtest/gtest.h>

#include "clv/cpu/parallel.h"
#include "support/hall_volume.h"
#include "viz/cell_values.h"
#include "viz/compose.h"

using namespace clv;
using namespace clv::test;

namespace {

TEST(ShownCells, eachPlaceIsShownByTheFinestCascadeThatHoldsIt) {
    const BakedVolume volume = hallVolume();
    const ClvCascades cascades = cascadesOf(volume);
    int fine = 0, coarse = 0;
    for (const ShownCell& cell : shownCells(volume, {}, serialFor())) {
        EXPECT_EQ(cell.cascade, clvCascadeFromPosition(cascades, cell.center));
        ++(cell.cascade == 0 ? fine : coarse);
    }
    EXPECT_GT(fine, 0);
    EXPECT_GT(coarse, 0);
}

TEST(ShownCells, ofOneCascadeAreAllOfItsOpenCellsHoweverDark) {
    BakedVolume volume = hallVolume();
    for (auto& estimate : volume.cascades[1].estimates) std::ranges::fill(estimate, 0.0f);
    const BakedCascade& cascade = volume.cascades[1];
    std::size_t open = 0;
    for (const uint entry : cascade.level.table) open += entry != kClvNoSlot ? 1 : 0;
    const auto cells = shownCells(volume, 1u, serialFor());
    EXPECT_EQ(cells.size(), open);
    for (const ShownCell& cell : cells) EXPECT_EQ(cell.center, clvCellCenter(cascade.level.volume, cell.cell));
}

TEST(Threshold, leavesOutCubesThatReceiveLessOnEverySide) {
    const BakedVolume volume = hallVolume();
    const auto all = shownCells(volume, {}, serialFor());
    View view;
    view.threshold = brightest(all[all.size() / 2].light);
    const auto cubes = cellsOf(volume, view, serialFor());
    EXPECT_EQ(std::ptrdiff_t(cubes.size()), std::ranges::count_if(all, [&](const ShownCell& cell) { return brightest(cell.light) >= view.threshold; }));
    EXPECT_GT(cubes.size(), 0u);
    EXPECT_LT(cubes.size(), all.size());
    view.subject = Subject::samples;
    EXPECT_EQ(cellsOf(volume, view, serialFor()).size(), cubes.size());
    view.carrier = Carrier::volume;
    EXPECT_EQ(cellsOf(volume, view, serialFor()).size(), all.size());
}

TEST(Threshold, leavesOutCubesWithoutLightUnlessItIsZero) {
    BakedVolume volume = hallVolume();
    for (auto& estimate : volume.cascades[1].estimates) std::ranges::fill(estimate, 0.0f);
    const auto all = shownCells(volume, {}, serialFor());
    View view;
    const auto cubes = cellsOf(volume, view, serialFor());
    EXPECT_GT(cubes.size(), 0u);
    EXPECT_TRUE(std::ranges::all_of(cubes, [](const ShownCell& cell) { return cell.cascade == 0; }));
    view.threshold = 0.0f;
    EXPECT_EQ(cellsOf(volume, view, serialFor()).size(), all.size());
}

TEST(ShownCells, aPositionFindsTheCellThatHoldsIt) {
    const BakedVolume volume = hallVolume();
    for (const ShownCell& cell : shownCells(volume, {}, serialFor())) {
        const auto found = cellAt(volume, cell.center + vec3(0.3f, -0.3f, 0.2f) * cell.edge, cell.cascade);
        ASSERT_TRUE(found);
        EXPECT_EQ(found->cell, cell.cell);
    }
    EXPECT_FALSE(cellAt(volume, vec3(1e3f), {}));
}

TEST(CellValues, ofTheWholeCellAreTheMeanOfItsSidesAndTheLargestDynamicity) {
    ShownCell cell{0, ivec3(0), vec3(0.0f), 2.0f, {}};
    for (std::size_t side = 0; side < kSides; ++side) {
        cell.light.irradiance[side] = vec3(float(side));
        cell.light.dynamicity[side] = side == 2 ? 0.75f : 0.25f;
        cell.light.variance[side] = float(2 * side);
    }
    cell.light.openVolume = 6.0f;
    cell.light.samples = 1000.0f;
    EXPECT_FLOAT_EQ(valueOf(cell, Quantity::irradiance, 3), 3.0f);
    EXPECT_FLOAT_EQ(valueOf(cell, Quantity::irradiance), 2.5f);
    EXPECT_FLOAT_EQ(valueOf(cell, Quantity::dynamicity), 0.75f);
    EXPECT_FLOAT_EQ(valueOf(cell, Quantity::variance), 5.0f);
    EXPECT_FLOAT_EQ(valueOf(cell, Quantity::open), 0.75f);
    EXPECT_FLOAT_EQ(valueOf(cell, Quantity::samples), 1000.0f);
}

TEST(CellValues, noiseIsTheStandardErrorInPercentOfTheIrradiance) {
    ShownCell cell{0, ivec3(0), vec3(0.0f), 2.0f, {}};
    EXPECT_EQ(valueOf(cell, Quantity::noise, 0), 100.0f) << "no light at all";
    EXPECT_EQ(valueOf(cell, Quantity::noise), 100.0f);
    cell.light.irradiance[0] = vec3(2.0f), cell.light.variance[0] = 0.04f;
    EXPECT_FLOAT_EQ(valueOf(cell, Quantity::noise, 0), 10.0f);
    EXPECT_FLOAT_EQ(valueOf(cell, Quantity::noise), 10.0f);
    cell.light.irradiance[1] = vec3(1.0f), cell.light.variance[1] = 4.0f;
    EXPECT_EQ(valueOf(cell, Quantity::noise, 1), 100.0f);
}

TEST(CellValues, ofASideThatOneHalfOfTheRaysFoundDarkTheNoiseIsWhole) {
    BakedVolume volume = hallVolume();
    for (BakedCascade& cascade : volume.cascades) std::ranges::fill(cascade.estimates[1], 0.0f);
    for (const ShownCell& cell : shownCells(volume, {}, serialFor())) EXPECT_FLOAT_EQ(valueOf(cell, Quantity::noise), 100.0f);
    volume.cascades[0].estimates[1] = volume.cascades[0].estimates[0];
    for (const ShownCell& cell : shownCells(volume, 0u, serialFor())) EXPECT_NEAR(valueOf(cell, Quantity::noise), 0.0f, 1e-4f);
}

TEST(CellValues, ofASingleEstimateNoNoiseIsDrawn) {
    const BakedVolume volume = hallVolume(1);
    for (const Subject subject : {Subject::noise, Subject::variance}) {
        View view;
        view.subject = subject;
        view.histogram = true;
        const Drawing drawing = compose(volume, nullptr, view, serialFor());
        EXPECT_TRUE(drawing.cubes.empty());
        EXPECT_FALSE(drawing.scale || drawing.plot);
        EXPECT_NE(drawing.caption.find("unknown"), std::string::npos) << drawing.caption;
    }
}

}  // namespace
