// Tables of a level that must not be walked.
#include "bindings/volume_file/level_check.h"

#include <gtest/gtest.h>

using namespace clv;

namespace {

// One cell whose two slots are told apart below so many splits.
Level chain(uint splits) {
    Level level{};
    level.volume.resolution = ivec3(1);
    level.volume.cellSize = 1.0f;
    level.table = {kClvSplitBit};
    for (uint s = 0; s < 2; ++s) level.slots.push_back({.openCentroid = vec3(0.5f), .openVolume = 0.5f, .visible = uvec4(~0u), .cell = 0, .pad0 = 0, .pad1 = 0, .pad2 = 0});
    for (uint k = 0; k < splits; ++k) {
        level.splits.push_back({.plane = vec4(1.0f, 0.0f, 0.0f, 0.1f * float(k)), .front = 0, .back = k + 1 < splits ? kClvSplitBit | (k + 1) : 1u, .firstSlot = 0, .slotCount = 2});
    }
    return level;
}

TEST(LevelCheck, splitsMayBeAsDeepAsReadersWalk) {
    for (int splits = 1; splits <= kClvMostSplits; ++splits) EXPECT_EQ(problemOf(chain(uint(splits))), "") << splits;
    EXPECT_EQ(problemOf(chain(uint(kClvMostSplits) + 1)), "cell 0: expected splits that end in slots of that cell");
}

}  // namespace
