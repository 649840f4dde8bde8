// Open regions of cells that geometry cuts: their number, volumes, and what they see of each other.
#include "clv/cpu/build_level.h"

#include <gtest/gtest.h>

#include "bindings/embree/embree_scene.h"
#include "box_scene.h"
#include "support/chi_square.h"

using namespace clv;
using test::Box;
using test::BoxScene;

namespace {

ClvVolume gridOver(const vec3& lo, int n, float cellSize) {
    ClvVolume volume{};
    volume.origin = lo;
    volume.resolution = ivec3(n);
    volume.cellSize = cellSize;
    return volume;
}

Level levelOf(const ClvVolume& volume, const SceneProbe& probe, int linesPerCell = 8) {
    BuildOptions options;
    options.linesPerCell = linesPerCell;
    return buildLevel(volume, probe, {}, serialFor(), options);
}

CellSlots slotsAt(const Level& level, const ivec3& cell) {
    const uint entry = level.table[clvCellIndex(level.volume, cell)];
    return entry == kClvNoSlot ? CellSlots{0, 0} : slotsOfCell(level, entry);
}

// Volume of the slots whose centroid lies in a box.
double openVolume(const Level& level, const vec3& lo = vec3(-1e9f), const vec3& hi = vec3(1e9f)) {
    double sum = 0.0;
    for (const ClvSlot& slot : level.slots) {
        const vec3 p = slot.openCentroid;
        if (p == clamp(p, lo, hi)) sum += slot.openVolume;
    }
    return sum;
}

TEST(BuildLevel, emptySpaceHasOneWholeSlotACell) {
    const Level level = levelOf(gridOver(vec3(-1.0f), 4, 0.5f), BoxScene{}.probe());
    EXPECT_EQ(level.slots.size(), 64u);
    EXPECT_TRUE(level.splits.empty());
    for (const ClvSlot& slot : level.slots) {
        EXPECT_FLOAT_EQ(slot.openVolume, 0.125f);
        EXPECT_EQ(slot.openCentroid, clvCellCenter(level.volume, clvCellFromIndex(level.volume, slot.cell)));
        EXPECT_EQ(slot.visible, uvec4(~0u));
    }
}

TEST(BuildLevel, cellsOfAnySizeAreCutAlike) {
    const auto levelAt = [](float scale) {
        BoxScene scene = test::hall();
        for (Box& box : scene.boxes) box.center *= scale, box.half *= scale;
        return levelOf(gridOver(scale * vec3(-11.0f, -4.1f, -8.2f), 14, 1.6f * scale), scene.probe(), 6);
    };
    const Level level = levelAt(1.0f);
    ASSERT_GT(level.splits.size(), 20u);
    // Powers of two, by which floats scale to the last bit: cells of 1e-9 and of 1e8 m.
    for (const float scale : {0x1p-30f, 0x1p26f}) {
        const Level scaled = levelAt(scale);
        EXPECT_EQ(scaled.table, level.table) << scale;
        EXPECT_EQ(scaled.splits.size(), level.splits.size()) << scale;
    }
}

TEST(BuildLevel, theOpenVolumesOfARoomAddUpToItsVolumeForEveryShiftOfTheGrid) {
    for (uint i = 0; i < 12; ++i) {
        const vec3 shift(test::randomUnit(1, i), test::randomUnit(2, i), test::randomUnit(3, i));
        const BoxScene scene{{{vec3(0.0f), vec3(1.0f, 0.8f, 1.3f), true}}};
        const Level level = levelOf(gridOver(vec3(-1.9f) + 0.3f * shift, 12, 0.3f), scene.probe());
        // The walls have no thickness: what lies outside is open as well, but in slots of its own.
        EXPECT_NEAR(openVolume(level, vec3(-1.0f, -0.8f, -1.3f), vec3(1.0f, 0.8f, 1.3f)) / (8.0 * 1.0 * 0.8 * 1.3), 1.0, 0.02) << i;
        EXPECT_NEAR(openVolume(level), std::pow(3.6, 3), 0.02) << i;
    }
}

TEST(BuildLevel, theOpenVolumeAroundATurnedBlockIsTheRestOfTheGrid) {
    const Box block{vec3(0.05f, -0.02f, 0.03f), vec3(0.52f, 0.41f, 0.33f), false, test::turned(0.6f)};
    const Level level = levelOf(gridOver(vec3(-1.0f), 8, 0.25f), BoxScene{{block}}.probe());
    EXPECT_NEAR(openVolume(level) / (8.0 - 8.0 * 0.52 * 0.41 * 0.33), 1.0, 0.01);
}

TEST(BuildLevel, theInsideOfASolidHasNoSlot) {
    const BoxScene scene{{{vec3(0.0f), vec3(0.6f)}}};
    const Level level = levelOf(gridOver(vec3(-1.0f), 8, 0.25f), scene.probe());
    for (int z = 2; z < 6; ++z) {
        for (int y = 2; y < 6; ++y) {
            for (int x = 2; x < 6; ++x) EXPECT_EQ(slotsAt(level, ivec3(x, y, z)).count, 0u) << x << y << z;
        }
    }
    EXPECT_EQ(slotsAt(level, ivec3(0)).count, 1u);
}

TEST(BuildLevel, aThinWallPartsACellIntoTwoSlotsOfTheRightVolumes) {
    const float h = 0.5f, thickness = 0.06f;
    for (int axis = 0; axis < 3; ++axis) {
        for (float place : {0.12f, 0.2f, 0.31f, 0.4f}) {  // m, the wall's middle, from the cell's lowest face
            Box wall{vec3(1.5f * h), vec3(2.0f * h)};
            wall.center[axis] = h + place;
            wall.half[axis] = 0.5f * thickness;
            const Level level = levelOf(gridOver(vec3(0.0f), 3, h), BoxScene{{wall}}.probe());
            const CellSlots slots = slotsAt(level, ivec3(1));
            ASSERT_EQ(slots.count, 2u) << axis << " " << place;
            vec3 below = vec3(h + 0.5f * h), above = below;
            below[axis] = h + 0.5f * (place - 0.5f * thickness);
            above[axis] = 2.0f * h - 0.5f * (h - place - 0.5f * thickness);
            for (const vec3& p : {below, above}) {
                const ClvSlot& slot = level.slots[slotAtPosition(level, level.table[clvCellIndex(level.volume, ivec3(1))], p)];
                const float depth = p == below ? place - 0.5f * thickness : h - place - 0.5f * thickness;
                EXPECT_NEAR(slot.openVolume, h * h * depth, 0.01f * h * h * h);
                EXPECT_NEAR(length(slot.openCentroid - p), 0.0f, 0.02f * h);
            }
            EXPECT_NE(slotAtPosition(level, level.table[clvCellIndex(level.volume, ivec3(1))], below),
                      slotAtPosition(level, level.table[clvCellIndex(level.volume, ivec3(1))], above));
        }
    }
}

TEST(BuildLevel, aTiltedThinWallPartsTheCellsThatItCrosses) {
    for (float angle : {0.2f, 0.5f, 0.78f}) {
        const Box wall{vec3(0.02f, 0.0f, 0.01f), vec3(0.02f, 10.0f, 10.0f), false, test::turned(angle)};
        const Level level = levelOf(gridOver(vec3(-1.25f), 5, 0.5f), BoxScene{{wall}}.probe());
        const CellSlots slots = slotsAt(level, ivec3(2));
        ASSERT_EQ(slots.count, 2u) << angle;
        const vec3 normal = wall.axes[0];
        // Points on either side of the wall are in slots of their own, and the two hold the cell but for the wall.
        const uint entry = level.table[clvCellIndex(level.volume, ivec3(2))];
        EXPECT_NE(slotAtPosition(level, entry, wall.center + normal * 0.08f), slotAtPosition(level, entry, wall.center - normal * 0.08f));
        const float wallVolume = 0.04f * 0.5f * 0.5f / std::cos(angle);
        EXPECT_NEAR(level.slots[slots.first].openVolume + level.slots[slots.first + 1].openVolume, 0.125f - wallVolume, 0.004f);
    }
}

TEST(BuildLevel, aCornerWhereThreeRoomsMeetHasThreeSlots) {
    // A wall through the cell, and one that meets it from one side.
    const BoxScene scene{{{vec3(0.0f, 0.0f, 0.0f), vec3(0.02f, 10.0f, 10.0f)}, {vec3(5.02f, 0.0f, 0.03f), vec3(5.0f, 10.0f, 0.02f)}}};
    const Level level = levelOf(gridOver(vec3(-0.75f), 3, 0.5f), scene.probe());
    ASSERT_GE(slotsAt(level, ivec3(1)).count, 3u);
    const uint entry = level.table[clvCellIndex(level.volume, ivec3(1))];
    const uint left = slotAtPosition(level, entry, vec3(-0.12f, 0.0f, 0.0f));
    const uint front = slotAtPosition(level, entry, vec3(0.12f, 0.0f, 0.15f)), back = slotAtPosition(level, entry, vec3(0.12f, 0.0f, -0.12f));
    EXPECT_NE(left, front);
    EXPECT_NE(left, back);
    EXPECT_NE(front, back);
    EXPECT_EQ(left, slotAtPosition(level, entry, vec3(-0.12f, 0.0f, 0.2f)));
}

TEST(BuildLevel, bothSidesOfASheetHaveSlots) {
    // One face without thickness, z = 0.1: it shows its front to +z.
    SceneProbe sheet;
    sheet.lineHits = [](const vec3& origin, const vec3& direction, float maxDistance, std::vector<LineHit>& hits) {
        hits.clear();
        if (direction.z == 0.0f) return;
        const float t = (0.1f - origin.z) / direction.z;
        if (t > 0.0f && t < maxDistance) hits.push_back({t, direction.z < 0.0f, vec3(0.0f, 0.0f, 1.0f)});
    };
    sheet.occluded = [](const vec3& from, const vec3& to) { return (from.z - 0.1f) * (to.z - 0.1f) < 0.0f; };
    const Level level = levelOf(gridOver(vec3(-0.75f), 3, 0.5f), sheet);
    const CellSlots slots = slotsAt(level, ivec3(1));
    ASSERT_EQ(slots.count, 2u);
    const uint entry = level.table[clvCellIndex(level.volume, ivec3(1))];
    EXPECT_NEAR(level.slots[slotAtPosition(level, entry, vec3(0.0f, 0.0f, 0.2f))].openVolume, 0.25f * 0.15f, 1e-3f);
    EXPECT_NEAR(level.slots[slotAtPosition(level, entry, vec3(0.0f, 0.0f, -0.1f))].openVolume, 0.25f * 0.35f, 1e-3f);
}

// Calls visit(s, other, mutual, k) for each pair of slots in neighbouring cells; `mutual`: both bits.
template <class Visit>
void forPairs(const Level& level, Visit&& visit) {
    for (uint s = 0; s < level.slots.size(); ++s) {
        const ivec3 cell = clvCellFromIndex(level.volume, level.slots[s].cell);
        const uint mine = s - slotsAt(level, cell).first;
        for (int k = 0; k < 27; ++k) {
            const ivec3 step(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
            if (clvCellInside(level.volume, cell + step) == 0) continue;
            const CellSlots others = slotsAt(level, cell + step);
            for (uint i = 0; i < others.count; ++i) {
                const uint other = others.first + i;
                const bool there = (level.slots[s].visible[int(i)] & clvNeighbourBit(step)) != 0u;
                const bool back = (level.slots[other].visible[int(mine)] & clvNeighbourBit(-step)) != 0u;
                visit(s, other, there, back);
            }
        }
    }
}

TEST(BuildLevel, visibilityIsMutual) {
    const Level level = levelOf(gridOver(vec3(-11.0f, -4.0f, -8.0f), 22, 1.0f), test::hall().probe(), 3);
    int pairs = 0, blocked = 0;
    forPairs(level, [&](uint s, uint other, bool there, bool back) {
        ASSERT_EQ(there, back) << s << " " << other;
        ++pairs;
        blocked += !there;
    });
    EXPECT_GT(pairs, 10000);
    EXPECT_GT(blocked, 100);
}

TEST(BuildLevel, slotsOnTheTwoSidesOfAThinWallDoNotSeeEachOther) {
    for (uint i = 0; i < 10; ++i) {
        const float x = 0.5f * test::randomUnit(1, i);
        const BoxScene scene{{{vec3(x, 0.0f, 0.0f), vec3(0.02f, 10.0f, 10.0f)}}};
        const Level level = levelOf(gridOver(vec3(-1.0f), 5, 0.5f), scene.probe());
        int across = 0, along = 0;
        forPairs(level, [&](uint s, uint other, bool there, bool) {
            const bool apart = (level.slots[s].openCentroid.x - x) * (level.slots[other].openCentroid.x - x) < 0.0f;
            EXPECT_EQ(there, !apart) << i;
            ++(apart ? across : along);
        });
        EXPECT_GT(across, 100);
        EXPECT_GT(along, 100);
    }
}

TEST(BuildLevel, cellsThatAreNotNeededHaveNoSlot) {
    const ClvVolume volume = gridOver(vec3(0.0f), 8, 1.0f);
    ClvReceiver receiver{};
    receiver.position = vec3(3.5f, 2.0f, 3.5f);
    receiver.normal = vec3(0.0f, 1.0f, 0.0f);
    const auto needed = neededCells(volume, std::span(&receiver, 1));
    const Level level = buildLevel(volume, BoxScene{}.probe(), needed, serialFor());
    EXPECT_EQ(level.slots.size(), 27u);
    for (std::size_t i = 0; i < needed.size(); ++i) EXPECT_EQ(level.table[i] != kClvNoSlot, needed[i] != 0) << i;
}

TEST(BuildLevel, aRoomOfTrianglesHasItsVolumeToo) {
    const Scene scene = makeBuiltinScene("furnace_box");
    const EmbreeScene embree(scene);
    const vec3 extent = scene.bounds.hi - scene.bounds.lo;
    for (uint i = 0; i < 4; ++i) {
        const vec3 shift(test::randomUnit(4, i), test::randomUnit(5, i), test::randomUnit(6, i));
        const Level level = levelOf(volumeOverBounds(scene.bounds.lo, scene.bounds.hi, 12, kClvStorageCube9, shift), embree.probe(), 4);
        EXPECT_NEAR(openVolume(level, scene.bounds.lo, scene.bounds.hi) / (double(extent.x) * extent.y * extent.z), 1.0, 0.02) << i;
    }
}

}  // namespace
