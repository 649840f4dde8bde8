// A level that has moved is the level that would be built where it stands.
#include <gtest/gtest.h>

#include "clv/cpu/moving_level.h"
#include "clv/math/hash.h"
#include "cpu/box_scene.h"

using namespace clv;
using namespace clv::test;

namespace {

const ivec3 kResolution(14, 9, 11);
constexpr double kCellSize = 0.9;

PlacedCascade placedAt(const ivec3& lowest) { return {LatticeCell(lowest), kResolution, kCellSize}; }

MovingLevelSettings settings() { return {.resolution = kResolution, .linesPerCell = 4}; }

MovingLevel movedAlong(const std::vector<ivec3>& path, const BoxScene& scene) {
    MovingLevel moving(settings());
    for (const ivec3& lowest : path) {
        moving.moveTo(placedAt(lowest));
        moving.fill(scene.probe(), serialFor());
    }
    return moving;
}

Level builtAt(const ivec3& lowest, const BoxScene& scene) { return movedAlong({lowest}, scene).level(); }

// What two levels at one place differ in.
struct Difference {
    std::size_t cells = 0, slots = 0, cutCells = 0;
    std::size_t counts = 0;      // cells whose numbers of slots differ
    std::size_t sights = 0, sightsCompared = 0;
    float volume = 0.0f;         // largest, relative to a cell
    float centroid = 0.0f;       // largest, cells
    std::size_t sides = 0;       // points of a cell that fall into different slots
};

Difference compare(const Level& a, const Level& b) {
    Difference d;
    const float h = a.volume.cellSize;
    for (std::size_t i = 0; i < a.cellCount(); ++i) {
        const ivec3 cell = clvCellFromIndex(a.volume, uint(i));
        const uint entryA = a.table[i], entryB = b.table[clvCellIndex(b.volume, cell)];
        ++d.cells;
        if (entryA == kClvNoSlot && entryB == kClvNoSlot) continue;
        if (entryA == kClvNoSlot || entryB == kClvNoSlot || slotsOfCell(a, entryA).count != slotsOfCell(b, entryB).count) {
            ++d.counts;
            continue;
        }
        const CellSlots slotsA = slotsOfCell(a, entryA), slotsB = slotsOfCell(b, entryB);
        d.cutCells += slotsA.count > 1;
        for (uint s = 0; s < slotsA.count; ++s) {
            const ClvSlot& slotA = a.slots[slotsA.first + s];
            const ClvSlot& slotB = b.slots[slotsB.first + s];
            ++d.slots;
            EXPECT_EQ(slotA.cell, uint(i));
            d.volume = std::max(d.volume, std::abs(slotA.openVolume - slotB.openVolume) / (h * h * h));
            d.centroid = std::max(d.centroid, glm::length(slotA.openCentroid - slotB.openCentroid) / h);
            for (int k = 0; k < 27; ++k) {
                const ivec3 other = cell + ivec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
                if (!clvCellInside(a.volume, other)) continue;
                for (int ordinal = 0; ordinal < int(kClvMostSlots); ++ordinal) {
                    ++d.sightsCompared;
                    d.sights += (slotA.visible[ordinal] >> k & 1u) != (slotB.visible[ordinal] >> k & 1u);
                }
            }
            const vec3 probe = slotB.openCentroid;
            d.sides += slotAtPosition(a, entryA, probe) - slotsA.first != slotAtPosition(b, entryB, probe) - slotsB.first;
        }
    }
    return d;
}

void expectSame(const Level& a, const Level& b) {
    const Difference d = compare(a, b);
    EXPECT_EQ(d.cells, std::size_t(kResolution.x) * kResolution.y * kResolution.z);
    EXPECT_GT(d.cutCells, 20u) << "the level holds no geometry worth comparing";
    EXPECT_EQ(d.counts, 0u);
    EXPECT_EQ(d.volume, 0.0f);
    EXPECT_EQ(d.centroid, 0.0f);
    EXPECT_EQ(d.sides, 0u);
    EXPECT_EQ(d.sights, 0u) << "of " << d.sightsCompared;
}

TEST(MovingLevel, equalsAStillLevelWhereItsStorageDoesNotWrap) {
    const BoxScene scene = hall();
    for (const ivec3& lowest : {-kResolution, ivec3(0), kResolution * ivec3(-1, 0, 0)}) {
        const ClvVolume volume = volumeFromCascade(placedAt(lowest), glm::dvec3(0.0), kClvStorageCube9);
        ASSERT_EQ(volume.scroll, ivec3(0));
        const Level still = buildLevel(volume, scene.probe(), {}, serialFor(), {.linesPerCell = settings().linesPerCell});
        expectSame(builtAt(lowest, scene), still);
    }
}

TEST(MovingLevel, equalsABuiltOneAfterSmallScrollsEitherWay) {
    const BoxScene scene = hall();
    const std::vector<ivec3> path{ivec3(-7, -4, -5), ivec3(-6, -4, -5), ivec3(-6, -3, -6), ivec3(-4, -5, -6), ivec3(-5, -4, -4), ivec3(-8, -4, -7)};
    for (std::size_t n = 2; n <= path.size(); ++n) {
        SCOPED_TRACE(n);
        expectSame(movedAlong({path.begin(), path.begin() + n}, scene).level(), builtAt(path[n - 1], scene));
    }
}

TEST(MovingLevel, equalsABuiltOneAfterAJumpBeyondItsSize) {
    const BoxScene scene = hall();
    expectSame(movedAlong({ivec3(-40, 70, 3), ivec3(-7, -4, -5)}, scene).level(), builtAt(ivec3(-7, -4, -5), scene));
    expectSame(movedAlong({ivec3(-7, -4, -5), ivec3(-20, -4, -5), ivec3(-5, -4, -4)}, scene).level(), builtAt(ivec3(-5, -4, -4), scene));
}

TEST(MovingLevel, equalsABuiltOneAfterARandomWalk) {
    const BoxScene scene = hall();
    std::vector<ivec3> path{ivec3(-7, -4, -5)};
    for (uint step = 0; step < 60; ++step) {
        ivec3 move;
        for (int axis = 0; axis < 3; ++axis) move[axis] = int(clvHashCombine(step, uint(axis)) % 5u) - 2;
        path.push_back(clamp(path.back() + move, ivec3(-13, -6, -9), ivec3(-2, -2, -2)));
    }
    expectSame(movedAlong(path, scene).level(), builtAt(path.back(), scene));
}

TEST(MovingLevel, leavesCellsThatStayAsTheyAreToTheLastBit) {
    const BoxScene scene = hall();
    MovingLevel moving = movedAlong({ivec3(-7, -4, -5)}, scene);
    const Level before = moving.level();
    moving.moveTo(placedAt(ivec3(-5, -5, -4)));
    moving.fill(scene.probe(), serialFor());
    const Level& after = moving.level();
    std::size_t kept = 0;
    for (uint i = 0; i < before.cellCount(); ++i) {
        const ivec3 cellBefore = clvCellFromIndex(before.volume, i);
        if (!clvCellInside(before.volume, cellBefore + ivec3(0)) || !clvCellInside(after.volume, cellBefore - ivec3(2, -1, 1))) continue;
        ASSERT_EQ(clvCellIndex(after.volume, cellBefore - ivec3(2, -1, 1)), i);
        ASSERT_EQ(before.table[i], after.table[i]);
        if (before.table[i] == kClvNoSlot) continue;
        const CellSlots slots = slotsOfCell(after, after.table[i]);
        for (uint s = slots.first; s < slots.first + slots.count; ++s) {
            EXPECT_EQ(before.slots[s].openVolume, after.slots[s].openVolume);
            EXPECT_EQ(before.slots[s].openCentroid, after.slots[s].openCentroid);
        }
        ++kept;
    }
    EXPECT_GT(kept, 600u);
}

TEST(MovingLevel, needsNoMoreSlotsWhenItComesBackToPlacesItHasSeen) {
    const BoxScene scene = hall();
    const std::vector<ivec3> lap{ivec3(-7, -4, -5), ivec3(-5, -4, -5), ivec3(-5, -3, -4), ivec3(-8, -3, -6)};
    MovingLevel moving(settings());
    std::vector<std::size_t> slots, splits;
    for (int round = 0; round < 4; ++round) {
        for (const ivec3& lowest : lap) {
            moving.moveTo(placedAt(lowest));
            moving.fill(scene.probe(), serialFor());
        }
        slots.push_back(moving.level().slots.size());
        splits.push_back(moving.level().splits.size());
    }
    EXPECT_EQ(slots[3], slots[1]);
    EXPECT_EQ(splits[3], splits[1]);
}

TEST(MovingLevel, statesItsMemoryBeforeItTakesIt) {
    MovingLevelSettings roomy = settings();
    roomy.slotsPerCell = 3.0f;
    const BoxScene scene = hall();
    MovingLevel moving(roomy);
    EXPECT_EQ(moving.bytes(), MovingLevel::bytes(roomy));
    moving.moveTo(placedAt(ivec3(-7, -4, -5)));
    moving.fill(scene.probe(), serialFor());
    EXPECT_EQ(moving.bytes(), MovingLevel::bytes(roomy));
}

TEST(BlockPool, handsOutRunsThatNeverOverlap) {
    BlockPool pool(4);
    std::vector<int> owner;
    std::vector<std::pair<uint, uint>> runs;
    for (uint step = 0; step < 2000; ++step) {
        const uint dice = clvHash(step);
        if (dice % 3u != 0u || runs.empty()) {
            const uint count = 1u + dice / 3u % 4u, first = pool.take(count);
            owner.resize(pool.size(), 0);
            for (uint i = first; i < first + count; ++i) ASSERT_EQ(owner[i]++, 0);
            runs.emplace_back(first, count);
        } else {
            const std::size_t pick = dice / 3u % runs.size();
            for (uint i = runs[pick].first; i < runs[pick].first + runs[pick].second; ++i) --owner[i];
            pool.giveBack(runs[pick].first, runs[pick].second);
            runs.erase(runs.begin() + std::ptrdiff_t(pick));
        }
    }
    EXPECT_GT(pool.size(), 100u);
}

}  // namespace
