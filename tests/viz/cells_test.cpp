// Which cells a view shows, and what their numbers are.
#include <gtest/gtest.h>

#include "clv/cpu/parallel.h"
#include "support/hall_volume.h"
#include "viz/cells.h"

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

TEST(ShownCells, ofOneCascadeAreAllOfItsCellsThatHoldLight) {
    const BakedVolume volume = hallVolume();
    const BakedCascade& cascade = volume.cascades[1];
    std::size_t open = 0;
    for (const uint entry : cascade.level.table) open += entry != kClvNoSlot ? 1 : 0;
    const auto cells = shownCells(volume, {.cascade = 1u}, serialFor());
    EXPECT_EQ(cells.size(), open);
    for (const ShownCell& cell : cells) EXPECT_EQ(cell.center, clvCellCenter(cascade.level.volume, cell.cell));
}

TEST(ShownCells, aThresholdLeavesOutCellsThatReceiveLessOnEverySide) {
    const BakedVolume volume = hallVolume();
    const auto brightest = [](const ShownCell& cell) {
        float most = 0.0f;
        for (const vec3& e : cell.light.irradiance) most = std::max({most, e.x, e.y, e.z});
        return most;
    };
    const auto all = shownCells(volume, {}, serialFor());
    const float threshold = brightest(all[all.size() / 2]);
    const auto few = shownCells(volume, {.cascade = {}, .threshold = threshold}, serialFor());
    std::size_t expected = 0;
    for (const ShownCell& cell : all) expected += brightest(cell) > threshold ? 1 : 0;
    EXPECT_EQ(few.size(), expected);
    EXPECT_GT(few.size(), 0u);
    EXPECT_LT(few.size(), all.size());
}

TEST(ShownCells, aPositionFindsTheCellThatHoldsIt) {
    const BakedVolume volume = hallVolume();
    for (const ShownCell& cell : shownCells(volume, {}, serialFor())) {
        const auto found = cellAt(volume, cell.center + vec3(0.3f, -0.3f, 0.2f) * cell.edge, {.cascade = cell.cascade});
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

}  // namespace
