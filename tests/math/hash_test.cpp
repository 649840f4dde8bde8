#include <gtest/gtest.h>

#include <array>
#include <set>

#include "clv/math/hash.h"
#include "support/chi_square.h"

using namespace clv;

namespace {

uint undoShift(uint x, int shift) {
    uint result = x;
    for (int known = shift; known < 32; known += shift) result = x ^ (result >> shift);
    return result;
}

// The inverse of an odd number modulo 2^32, by Newton's iteration.
uint inverseOf(uint odd) {
    uint inverse = odd;
    for (int i = 0; i < 5; ++i) inverse *= 2u - odd * inverse;
    return inverse;
}

TEST(Hash, canBeUndoneSoNoTwoInputsCollide) {
    for (uint i = 0; i < 1000000; ++i) {
        uint x = i * 4291u;
        uint y = undoShift(clvHash(x), 15) * inverseOf(0xd35a2d97u);
        y = undoShift(y, 15) * inverseOf(0x21f0aaadu);
        ASSERT_EQ(undoShift(y, 16), x);
    }
}

TEST(Hash, eachInputBitFlipsEachOutputBitHalfOfTheTime) {
    constexpr int samples = 20000;
    for (int in = 0; in < 32; ++in) {
        std::array<int, 32> flips{};
        for (uint i = 0; i < samples; ++i) {
            uint difference = clvHash(i * 0x9e3779b9u) ^ clvHash((i * 0x9e3779b9u) ^ (1u << in));
            for (int out = 0; out < 32; ++out) flips[out] += (difference >> out) & 1u;
        }
        // 1024 pairs of bits; sigma of a fair coin's share is 0.0035. The hash itself is biased by about 0.01.
        for (int out = 0; out < 32; ++out) EXPECT_NEAR(flips[out] / double(samples), 0.5, 0.025) << in << " " << out;
    }
}

TEST(Hash, seedsAFixedDistanceApartDoNotGiveShiftedStreams) {
    for (uint distance = 1; distance <= 16; ++distance) {
        for (int shift = -16; shift <= 16; ++shift) {
            int equal = 0;
            for (uint i = 100; i < 600; ++i) equal += clvHashCombine(7u, i) == clvHashCombine(7u + distance, i + uint(shift));
            EXPECT_LE(equal, 1) << distance << " " << shift;
        }
    }
}

TEST(Hash, combinedHashesAreUniformOverValuesAndOverSeeds) {
    constexpr int bins = 257, samples = 200000;
    std::array<double, bins> byValue{}, bySeed{}, expected{};
    expected.fill(samples / double(bins));
    for (uint i = 0; i < samples; ++i) {
        byValue[int(clvHashCombine(3u, i) * double(bins) / 4294967296.0)] += 1.0;
        bySeed[int(clvHashCombine(i, 3u) * double(bins) / 4294967296.0)] += 1.0;
    }
    EXPECT_GT(test::chiSquareChance(byValue, expected), 1e-3);
    EXPECT_GT(test::chiSquareChance(bySeed, expected), 1e-3);
}

TEST(Hash, combiningIsNotSymmetricAndZerosAreNotAFixedPoint) {
    EXPECT_NE(clvHashCombine(1u, 2u), clvHashCombine(2u, 1u));
    EXPECT_NE(clvHashCombine(0u, 0u), 0u);
}

TEST(Hash, unitFloatStaysBelowOne) {
    EXPECT_EQ(clvUnitFloat(0u), 0.0f);
    EXPECT_EQ(clvUnitFloat(0x80000000u), 0.5f);
    EXPECT_LT(clvUnitFloat(0xffffffffu), 1.0f);
    EXPECT_EQ(1.0f - clvUnitFloat(0xffffffffu), std::ldexp(1.0f, -24));
}

TEST(Hash, valuesStayAsTheyAre) {
    EXPECT_EQ(clvHash(0u), 0u);
    EXPECT_EQ(clvHash(1u), 0x06d3fa73u);
    EXPECT_EQ(clvHash(0xffffffffu), 0xd9b56683u);
    EXPECT_EQ(clvHashCombine(1u, 2u), 0xd90b18d6u);
}

}  // namespace
