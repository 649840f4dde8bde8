#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "clv/math/sobol.h"
#include "support/chi_square.h"

using namespace clv;

namespace {

// The first four rows of Joe and Kuo's new-joe-kuo-6 (2008): degree s, inner coefficients a, initial numbers m.
struct JoeKuo {
    int s;
    uint a;
    std::array<uint, 3> m;
};
constexpr std::array<JoeKuo, 3> kJoeKuo{{{1, 0, {1}}, {2, 1, {1, 3}}, {3, 1, {1, 3, 1}}}};

// Their recurrence, equation 2: m_k = 2 a_1 m_{k-1} ^ 2^2 a_2 m_{k-2} ^ ... ^ 2^s m_{k-s} ^ m_{k-s}, shifted to direction numbers.
std::array<uint, 32> directionNumbers(uint dimension) {
    std::array<uint, 32> v{};
    for (int k = 0; k < 32; ++k) {
        if (dimension == 0) {
            v[k] = 1u << (31 - k);
            continue;
        }
        const JoeKuo& row = kJoeKuo[dimension - 1];
        if (k < row.s) {
            v[k] = row.m[k] << (31 - k);
            continue;
        }
        v[k] = v[k - row.s] ^ (v[k - row.s] >> row.s);
        for (int i = 1; i < row.s; ++i) {
            if ((row.a >> (row.s - 1 - i)) & 1u) v[k] ^= v[k - i];
        }
    }
    return v;
}

// Most points of the first 2^m in one of the rectangles of 2^-a by 2^-b, over all a + b = m - t; 2^t where they spread evenly.
uint mostInARectangle(int m, int t, int first, int second, uint start, uint seed) {
    uint most = 0;
    for (int a = 0; a <= m - t; ++a) {
        int b = m - t - a;
        std::vector<uint> counts(std::size_t(1) << (m - t));
        for (uint i = 0; i < (1u << m); ++i) {
            vec4 p = clvSobol4(start + i, seed);
            uint x = uint(p[first] * float(1 << a)), y = uint(p[second] * float(1 << b));
            most = std::max(most, ++counts[(x << b) | y]);
        }
    }
    return most;
}

TEST(Sobol, equalsTheRecurrencesOfJoeAndKuo) {
    for (uint dimension = 0; dimension < kClvSobolDimensions; ++dimension) {
        std::array<uint, 32> v = directionNumbers(dimension);
        for (uint i = 0; i < 40000; ++i) {
            uint index = i < 20000 ? i : clvHash(i), expected = 0;
            for (int bit = 0; bit < 32; ++bit) expected ^= (index >> bit) & 1u ? v[bit] : 0u;
            ASSERT_EQ(clvSobol(index, dimension), expected) << dimension << " " << index;
        }
    }
}

TEST(Sobol, everyDimensionPutsOnePointInEachElementaryInterval) {
    constexpr int m = 12;
    for (uint start : {0u, 5u << m}) {
        for (uint dimension = 0; dimension < kClvSobolDimensions; ++dimension) {
            std::vector<int> plain(1 << m), scrambled(1 << m);
            for (uint i = 0; i < (1u << m); ++i) {
                ++plain[clvSobol(start + i, dimension) >> (32 - m)];
                ++scrambled[uint(clvSobolUnit(start + i, dimension, 99u) * float(1 << m))];
            }
            EXPECT_EQ(plain, std::vector<int>(1 << m, 1));
            EXPECT_EQ(scrambled, std::vector<int>(1 << m, 1));
        }
    }
}

TEST(Sobol, firstPairIsAPerfectNet) {
    for (int m : {2, 5, 8, 12}) {
        EXPECT_EQ(mostInARectangle(m, 0, 0, 1, 0u, 1u), 1u) << m;
        EXPECT_EQ(mostInARectangle(m, 0, 0, 1, 3u << m, 2u), 1u) << m;
    }
}

TEST(Sobol, secondPairIsStratifiedToFourPointsARectangle) {
    for (int m : {5, 8, 12}) {
        EXPECT_EQ(mostInARectangle(m, 2, 2, 3, 0u, 1u), 4u) << m;
        EXPECT_EQ(mostInARectangle(m, 2, 2, 3, 3u << m, 2u), 4u) << m;
    }
}

TEST(Sobol, allFourDimensionsTogetherAreStratified) {
    // t = sum of (degree - 1) = 3 over the four dimensions: 2^12 points put 8 in each of 512 boxes of any shape.
    std::vector<int> boxes(512);
    for (uint i = 0; i < 4096; ++i) {
        vec4 p = clvSobol4(i, 5u);
        uint x = uint(p.x * 8.0f), y = uint(p.y * 4.0f), z = uint(p.z * 4.0f), w = uint(p.w * 4.0f);
        ++boxes[((x * 4 + y) * 4 + z) * 4 + w];
    }
    EXPECT_EQ(boxes, std::vector<int>(512, 8));
}

TEST(OwenScramble, keepsCommonLeadingBitsAndOnlyThose) {
    for (uint i = 0; i < 20000; ++i) {
        uint x = clvHash(i), seed = clvHash(~i);
        for (int bit = 0; bit < 32; ++bit) {
            // y shares the bits above `bit` with x, differs there, and is anything below.
            uint y = x ^ (1u << bit) ^ (clvHash(x + uint(bit)) & ((1u << bit) - 1u));
            uint difference = clvOwenScramble(x, seed) ^ clvOwenScramble(y, seed);
            ASSERT_EQ(difference >> bit, 1u);
        }
    }
}

TEST(OwenScramble, everyPointIsUniformOverTheSeeds) {
    constexpr int bins = 65, seeds = 40000;
    for (uint index : {0u, 1u, 6u, 1000u}) {
        for (uint dimension = 0; dimension < kClvSobolDimensions; ++dimension) {
            std::array<double, bins> counts{}, expected{};
            expected.fill(seeds / double(bins));
            for (uint seed = 0; seed < seeds; ++seed) counts[int(clvSobolUnit(index, dimension, seed) * bins)] += 1.0;
            EXPECT_GT(test::chiSquareChance(counts, expected), 1e-4) << index << " " << dimension;
        }
    }
}

TEST(OwenScramble, seedsAreIndependentOfEachOther) {
    constexpr int points = 256, pairs = 2000;
    // Mean product of centred coordinates, of variance 1/12 each: it vanishes for independent seeds, within 4.5 sigma here.
    for (uint distance : {1u, 2u, 256u, 65536u}) {
        for (int dimension = 0; dimension < 4; ++dimension) {
            double sum = 0.0, squares = 0.0;
            for (uint pair = 0; pair < pairs; ++pair) {
                double product = 0.0;
                for (uint i = 0; i < points; ++i) {
                    product += (clvSobol4(i, pair)[dimension] - 0.5) * (clvSobol4(i, pair + distance)[dimension] - 0.5);
                }
                sum += product;
                squares += product * product;
            }
            EXPECT_LT(std::abs(sum), 4.5 * std::sqrt(squares)) << distance << " " << dimension;
        }
    }
}

TEST(OwenScramble, integratesWithoutBiasAndFarBetterThanRandomPoints) {
    constexpr int points = 1024, seeds = 400;
    // f = prod (1.5 sqrt(x)): its integral is 1, its variance (9/8)^4 - 1.
    double sum = 0.0, squares = 0.0;
    for (uint seed = 0; seed < seeds; ++seed) {
        double mean = 0.0;
        for (uint i = 0; i < points; ++i) {
            vec4 p = clvSobol4(i, seed);
            mean += 5.0625 * std::sqrt(double(p.x) * p.y * p.z * p.w) / points;
        }
        sum += mean - 1.0;
        squares += (mean - 1.0) * (mean - 1.0);
    }
    double variance = squares / seeds, randomVariance = (std::pow(9.0 / 8.0, 4.0) - 1.0) / points;
    EXPECT_LT(std::abs(sum / seeds), 4.0 * std::sqrt(variance / seeds));
    EXPECT_LT(variance, randomVariance / 50.0);
}

TEST(Sobol, coordinatesStayBelowOne) {
    for (uint i = 0; i < 200000; ++i) {
        vec4 p = clvSobol4(clvHash(i), 11u);
        ASSERT_TRUE(p.x >= 0.0f && p.x < 1.0f && p.y >= 0.0f && p.y < 1.0f && p.z >= 0.0f && p.z < 1.0f && p.w >= 0.0f && p.w < 1.0f);
    }
}

TEST(Sobol, valuesStayAsTheyAre) {
    EXPECT_EQ(clvSobol(6u, 0u), 0x60000000u);
    EXPECT_EQ(clvSobol(6u, 1u), 0x60000000u);
    EXPECT_EQ(clvSobol(6u, 2u), 0xa0000000u);
    EXPECT_EQ(clvSobol(6u, 3u), 0xe0000000u);
    EXPECT_EQ(clvOwenScramble(0x12345678u, 42u), 0x687261cdu);
    vec4 p = clvSobol4(12345u, 7u);
    EXPECT_EQ(p * 16777216.0f, vec4(10118483.0f, 5108607.0f, 12184520.0f, 13228486.0f));
}

}  // namespace
