#include "clv/data/light_volume.h"

#include <gtest/gtest.h>

#include <set>

#include "clv/cpu/level.h"
#include "support/chi_square.h"

using namespace clv;

namespace {

ClvVolume someVolume() {
    ClvVolume v{};
    v.origin = vec3(-2.0f, 3.0f, 0.25f);
    v.cellSize = 0.5f;
    v.resolution = ivec3(5, 7, 3);
    v.scroll = ivec3(4, 2, 1);
    return v;
}

TEST(LightVolume, indexOfACellIsOneToOneAndItsInverseFindsTheCell) {
    const ClvVolume v = someVolume();
    std::set<uint> seen;
    for (int z = 0; z < 3; ++z) {
        for (int y = 0; y < 7; ++y) {
            for (int x = 0; x < 5; ++x) {
                const uint index = clvCellIndex(v, ivec3(x, y, z));
                EXPECT_LT(index, 105u);
                EXPECT_TRUE(seen.insert(index).second);
                EXPECT_EQ(clvCellFromIndex(v, index), ivec3(x, y, z));
            }
        }
    }
}

TEST(LightVolume, aScrolledVolumeKeepsCellsThatStayWhereTheyAre) {
    // Moved by one cell along x: the cell that was number 1 is number 0 now, at the same place in memory.
    ClvVolume v = someVolume(), moved = v;
    moved.scroll.x = (v.scroll.x + 1) % v.resolution.x;
    for (int x = 1; x < 5; ++x) EXPECT_EQ(clvCellIndex(moved, ivec3(x - 1, 3, 2)), clvCellIndex(v, ivec3(x, 3, 2)));
}

TEST(LightVolume, aPositionLiesInTheCellAroundItsCentre) {
    const ClvVolume v = someVolume();
    for (uint i = 0; i < 10000; ++i) {
        const vec3 p = v.origin + 4.0f * vec3(test::randomUnit(1, i), test::randomUnit(2, i), test::randomUnit(3, i)) - 1.0f;
        const ivec3 cell = clvCellFromPosition(v, p);
        const vec3 d = abs(p - clvCellCenter(v, cell));
        ASSERT_LE(std::max(d.x, std::max(d.y, d.z)), 0.5f * v.cellSize * 1.00001f);
    }
    EXPECT_EQ(clvCellInside(v, clvCellFromPosition(v, vec3(1e30f, 3.1f, 0.3f))), 0);
    EXPECT_EQ(clvClampCell(v, clvCellFromPosition(v, vec3(1e30f, -1e30f, 0.3f))), ivec3(4, 0, 0));
}

TEST(LightVolume, volumeOverBoundsCoversThemWithCubesOfTheRightSizeForEveryShift) {
    const vec3 lo(-3.0f, 1.0f, 2.0f), hi(5.0f, 4.0f, 6.0f);
    for (int n : {8, 31, 64}) {
        for (uint i = 0; i < 50; ++i) {
            const vec3 shift(test::randomUnit(1, i), test::randomUnit(2, i), test::randomUnit(3, i));
            const ClvVolume v = volumeOverBounds(lo, hi, n, kClvStorageCube9, shift);
            EXPECT_NEAR(v.cellSize, std::cbrt(8.0 * 3.0 * 4.0) / n, 1e-6);
            const vec3 top = v.origin + v.cellSize * vec3(v.resolution);
            for (int axis = 0; axis < 3; ++axis) {
                // Half a cell of air on every side, and less than two cells too many.
                EXPECT_LE(v.origin[axis], lo[axis] - 0.499f * v.cellSize);
                EXPECT_GE(top[axis], hi[axis] + 0.499f * v.cellSize);
                EXPECT_LE(top[axis] - v.origin[axis], hi[axis] - lo[axis] + 3.001f * v.cellSize);
            }
        }
    }
}

TEST(LightVolume, aFlatSceneStillGetsCells) {
    const ClvVolume v = volumeOverBounds(vec3(0.0f), vec3(4.0f, 0.0f, 4.0f), 16, kClvStorageCube);
    EXPECT_GT(v.cellSize, 0.0f);
    EXPECT_GE(v.resolution.y, 1);
    EXPECT_LT(std::size_t(v.resolution.x) * v.resolution.y * v.resolution.z, 40000u);
}

TEST(Level, aSplitTreeLeadsEachPositionToItsSlot) {
    // A plane at x = 1, behind it one at y = 2.
    Level level;
    level.volume = someVolume();
    level.splits = {{vec4(1.0f, 0.0f, 0.0f, 1.0f), 5u, kClvSplitBit | 1u, 5u, 3u}, {vec4(0.0f, 1.0f, 0.0f, 2.0f), 6u, 7u, 0u, 0u}};
    EXPECT_EQ(slotAtPosition(level, kClvSplitBit, vec3(1.5f, 9.0f, 0.0f)), 5u);
    EXPECT_EQ(slotAtPosition(level, kClvSplitBit, vec3(0.5f, 2.5f, 0.0f)), 6u);
    EXPECT_EQ(slotAtPosition(level, kClvSplitBit, vec3(0.5f, 1.5f, 0.0f)), 7u);
    EXPECT_EQ(slotAtPosition(level, 3u, vec3(0.0f)), 3u);
    EXPECT_EQ(slotAtPosition(level, kClvNoSlot, vec3(0.0f)), kClvNoSlot);
    EXPECT_EQ(slotsOfCell(level, kClvSplitBit).first, 5u);
    EXPECT_EQ(slotsOfCell(level, kClvSplitBit).count, 3u);
    EXPECT_EQ(slotsOfCell(level, 9u).count, 1u);
}

TEST(DepositLayout, aRecordIsPaddedToWholeVectors) {
    struct Case {
        uint storage;
        int channels, values, stride;
    };
    for (const Case& c : {Case{kClvStorageCube9, 3, 27, 32}, {kClvStorageCube9, 1, 9, 16}, {kClvStorageCube, 3, 18, 24}, {kClvStorageCube, 1, 6, 8},
                          {kClvStorageSh1, 3, 12, 16}, {kClvStorageSh1, 1, 4, 8}, {kClvStorageSh2, 3, 27, 32}, {kClvStorageSh2, 1, 9, 16}}) {
        const DepositLayout layout{c.storage, c.channels};
        EXPECT_EQ(layout.values(), c.values);
        EXPECT_EQ(layout.stride(), c.stride);
        EXPECT_EQ(layout.bytes(10), std::size_t(c.stride) * 40);
    }
}

}  // namespace
