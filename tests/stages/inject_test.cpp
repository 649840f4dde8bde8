// The weights and interval rules of the inject stage; the walk itself is tested with the packets that follow it (tests/cpu).
#include "clv/stages/inject.h"

#include <gtest/gtest.h>

using namespace clv;

namespace {

TEST(Inject, aCrossingWeighsItsLengthInMetres) {
    const ClvCrossing crossing{ivec3(0), 1.25f, 2.0f, 1};
    EXPECT_FLOAT_EQ(clvCrossingWeight(kClvInjectTrackLength, crossing, 0.5f), 0.375f);
}

TEST(Inject, theThesisWeighsEveryCellOneButTheFirst) {
    EXPECT_EQ(clvCrossingWeight(kClvInjectThesis, ClvCrossing{ivec3(0), 1.0f, 1.1f, 0}, 0.5f), 1.0f);
    EXPECT_EQ(clvCrossingWeight(kClvInjectThesis, ClvCrossing{ivec3(0), 0.0f, 1.1f, 1}, 0.5f), 0.0f);
}

TEST(Inject, aSlabIsTheIntervalBetweenItsPlanes) {
    EXPECT_EQ(clvWalkSlab(-1.0f, 0.5f, 2.0f, 4.0f), vec2(2.0f, 10.0f));
    EXPECT_EQ(clvWalkSlab(5.0f, -0.5f, -2.0f, 4.0f), vec2(2.0f, 10.0f));
}

TEST(Inject, aParallelRayIsInItsSlabForEverOrNever) {
    for (float direction : {0.0f, 1e-30f, -1e-30f}) {
        const float inverse = clvWalkInverse(direction);
        EXPECT_EQ(inverse, 1.0f);
        EXPECT_EQ(clvWalkSlab(2.0f, direction, inverse, 4.0f), vec2(-kClvNever, kClvNever));
        EXPECT_EQ(clvWalkSlab(0.0f, direction, inverse, 4.0f), vec2(-kClvNever, kClvNever));
        const vec2 outside = clvWalkSlab(-0.5f, direction, inverse, 4.0f);
        EXPECT_GT(outside.x, outside.y);
        EXPECT_EQ(clvWalkFirstBoundary(direction, 2), kClvNever);
    }
}

TEST(Inject, theFirstBoundaryLiesAhead) {
    EXPECT_EQ(clvWalkFirstBoundary(0.1f, 2), 3.0f);
    EXPECT_EQ(clvWalkFirstBoundary(-0.1f, 2), 2.0f);
}

}  // namespace
