#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "clv/math/finite.h"
#include "clv/math/hash.h"
#include "clv/math/pack.h"
#include "support/chi_square.h"

using namespace clv;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// A number of at least 0 whose exponent is spread evenly over [2^lo, 2^hi).
float spread(uint seed, uint index, int lo, int hi) {
    return std::ldexp(1.0f + test::randomUnit(seed, 2u * index), lo + int(test::randomUnit(seed, 2u * index + 1u) * float(hi - lo)));
}

TEST(Finite, knowsInfinityAndNan) {
    EXPECT_TRUE(clvIsFinite(0.0f) && clvIsFinite(std::numeric_limits<float>::max()) && clvIsFinite(-1e-45f));
    EXPECT_FALSE(clvIsFinite(kInfinity) || clvIsFinite(-kInfinity) || clvIsFinite(kNan));
    EXPECT_FALSE(clvIsFinite(vec3(0.0f, kNan, 0.0f)));
}

TEST(Round, takesTheNearestIntegerAndHalvesUp) {
    EXPECT_EQ(clvRound(0.5f), 1u);
    EXPECT_EQ(clvRound(1.5f), 2u);
    EXPECT_EQ(clvRound(2.5f), 3u);
    EXPECT_EQ(clvRound(std::nextafter(0.5f, 0.0f)), 0u);
    EXPECT_EQ(clvRound(8388609.0f), 8388609u);
    EXPECT_EQ(clvRound(16777215.0f), 16777215u);
}

TEST(Unorm16, roundTripsAllCodesAndRoundsToTheNearest) {
    for (uint code = 0; code < 65536u; ++code) ASSERT_EQ(clvUnorm16FromFloat(clvFloatFromUnorm16(code)), code);
    for (uint i = 0; i < 200000; ++i) {
        float x = test::randomUnit(1u, i);
        ASSERT_NEAR(clvFloatFromUnorm16(clvUnorm16FromFloat(x)), x, 1.0f / 131070.0f + 1e-7f);
    }
}

TEST(Unorm16, takesAnyInput) {
    EXPECT_EQ(clvUnorm16FromFloat(-1.0f), 0u);
    EXPECT_EQ(clvUnorm16FromFloat(kNan), 0u);
    EXPECT_EQ(clvUnorm16FromFloat(kInfinity), 65535u);
}

TEST(Snorm16, roundTripsAllCodesAndRoundsToTheNearest) {
    for (uint code = 0; code < 65536u; ++code) {
        ASSERT_EQ(clvSnorm16FromFloat(clvFloatFromSnorm16(code)), code == 0x8000u ? 0x8001u : code);
    }
    for (uint i = 0; i < 200000; ++i) {
        float x = 2.0f * test::randomUnit(2u, i) - 1.0f;
        ASSERT_NEAR(clvFloatFromSnorm16(clvSnorm16FromFloat(x)), x, 1.0f / 65534.0f + 1e-7f);
        ASSERT_EQ(clvFloatFromSnorm16(clvSnorm16FromFloat(-x)), -clvFloatFromSnorm16(clvSnorm16FromFloat(x)));
    }
}

TEST(Snorm16, takesAnyInput) {
    EXPECT_EQ(clvSnorm16FromFloat(kNan), 0u);
    EXPECT_EQ(clvFloatFromSnorm16(clvSnorm16FromFloat(7.0f)), 1.0f);
    EXPECT_EQ(clvFloatFromSnorm16(clvSnorm16FromFloat(-kInfinity)), -1.0f);
    EXPECT_EQ(clvFloatFromSnorm16(0x8000u), -1.0f);
}

TEST(Half, roundTripsAllCodes) {
    for (uint code = 0; code < 65536u; ++code) {
        float x = clvFloatFromHalf(code);
        ASSERT_TRUE(clvIsFinite(x));
        ASSERT_EQ(std::signbit(x), code >> 15 == 1u);
        bool special = ((code >> 10) & 31u) == 31u;
        ASSERT_EQ(clvHalfFromFloat(x), special ? (code & 0x8000u) | 0x7bffu : code);
    }
}

TEST(Half, hasTheValuesOfIeee754) {
    EXPECT_EQ(clvFloatFromHalf(0x3c00u), 1.0f);
    EXPECT_EQ(clvFloatFromHalf(0xc000u), -2.0f);
    EXPECT_EQ(clvFloatFromHalf(0x7bffu), 65504.0f);
    EXPECT_EQ(clvFloatFromHalf(0x0001u), std::ldexp(1.0f, -24));
    EXPECT_EQ(clvFloatFromHalf(0x3555u), 0.333251953125f);
}

TEST(Half, roundsToTheNearestAndTiesToEven) {
    for (uint code = 0; code + 1u < 0x7c00u; ++code) {
        float low = clvFloatFromHalf(code), high = clvFloatFromHalf(code + 1u), middle = 0.5f * (low + high);
        ASSERT_EQ(clvHalfFromFloat(middle), code + (code & 1u));
        ASSERT_EQ(clvHalfFromFloat(std::nextafter(middle, 0.0f)), code);
        ASSERT_EQ(clvHalfFromFloat(std::nextafter(middle, 1e6f)), code + 1u);
        ASSERT_EQ(clvHalfFromFloat(-std::nextafter(middle, 1e6f)), 0x8000u | (code + 1u));
    }
}

TEST(Half, takesAnyInput) {
    EXPECT_EQ(clvHalfFromFloat(1e30f), 0x7bffu);
    EXPECT_EQ(clvHalfFromFloat(65520.0f), 0x7bffu);
    EXPECT_EQ(clvHalfFromFloat(-kInfinity), 0xfbffu);
    EXPECT_EQ(clvHalfFromFloat(kNan) & 0x7fffu, 0u);
    EXPECT_EQ(clvHalfFromFloat(1e-40f), 0u);
}

TEST(Rgb9e5, writesTheBitsOfTheTextureFormat) {
    EXPECT_EQ(clvRgb9e5FromFloat(vec3(1.0f, 1.0f, 1.0f)), 0x84020100u);
    EXPECT_EQ(clvRgb9e5FromFloat(vec3(0.0f, 0.0f, 0.0f)), 0u);
    EXPECT_EQ(clvFloatFromRgb9e5(0xffffffffu), vec3(65408.0f));
    EXPECT_EQ(clvRgb9e5FromFloat(vec3(1e9f, -1.0f, kNan)), 0xf80001ffu);
}

TEST(Rgb9e5, errsByAtMostHalfAStepOfTheLargestChannel) {
    for (uint i = 0; i < 300000; ++i) {
        vec3 rgb(spread(3u, i, -20, 15), spread(4u, i, -20, 15), spread(5u, i, -20, 15));
        float largest = std::max({rgb.x, rgb.y, rgb.z});
        vec3 error = abs(clvFloatFromRgb9e5(clvRgb9e5FromFloat(rgb)) - rgb);
        float bound = std::max(std::ldexp(largest, -9), std::ldexp(1.0f, -25));
        ASSERT_LE(std::max({error.x, error.y, error.z}), bound);
    }
}

TEST(Rgb9e5, valuesThatItCanHoldComeBackExactly) {
    for (uint i = 0; i < 300000; ++i) {
        vec3 rgb = clvFloatFromRgb9e5(clvHash(i));
        ASSERT_EQ(clvFloatFromRgb9e5(clvRgb9e5FromFloat(rgb)), rgb);
    }
}

TEST(SharedExponent, keepsTheLargestChannelAndErrsLittleInTheOthers) {
    for (uint i = 0; i < 300000; ++i) {
        int centre = int(test::randomUnit(9u, i) * 190.0f) - 95;
        vec3 rgb(spread(6u, i, centre, centre + 30), spread(7u, i, centre, centre + 30), spread(8u, i, centre, centre + 30));
        vec3 back = clvFloatFromSharedExponent(clvSharedExponentFromFloat(rgb));
        float largest = std::max({rgb.x, rgb.y, rgb.z});
        vec3 error = abs(back - rgb);
        ASSERT_EQ(std::max({back.x, back.y, back.z}), largest);
        ASSERT_LE(std::max({error.x, error.y, error.z}), std::ldexp(largest, -24));
    }
}

TEST(SharedExponent, holdsTheWholeRangeOfFloats) {
    float top = std::numeric_limits<float>::max(), bottom = std::numeric_limits<float>::min();
    EXPECT_EQ(clvFloatFromSharedExponent(clvSharedExponentFromFloat(vec3(top, 0.0f, top))), vec3(top, 0.0f, top));
    EXPECT_EQ(clvFloatFromSharedExponent(clvSharedExponentFromFloat(vec3(bottom, 0.0f, 0.0f))), vec3(bottom, 0.0f, 0.0f));
    EXPECT_EQ(clvFloatFromSharedExponent(clvSharedExponentFromFloat(vec3(kInfinity, -1.0f, kNan))), vec3(top, 0.0f, 0.0f));
}

TEST(SharedExponent, anyBitsAreFinite) {
    for (uint i = 0; i < 100000; ++i) {
        ASSERT_TRUE(clvIsFinite(clvFloatFromSharedExponent(uvec4(clvHash(i), clvHash(i + 1u), clvHash(i + 2u), i & 0xffu))));
    }
}

TEST(R11g11b10, roundTripsAllCodes) {
    for (uint code = 0; code < 31u << 6; ++code) {
        const uint packed = code | (code << 11) | ((code >> 1) << 22);
        ASSERT_EQ(clvR11g11b10FromFloat(clvFloatFromR11g11b10(packed)), packed);
    }
}

TEST(R11g11b10, roundsToTheNearest) {
    for (uint i = 0; i < 100000; ++i) {
        const vec3 x(spread(21u, i, -14, 15), spread(22u, i, -14, 15), spread(23u, i, -14, 15));
        const vec3 error = abs(clvFloatFromR11g11b10(clvR11g11b10FromFloat(x)) / x - 1.0f);
        ASSERT_LE(error.x, 0x1p-7f * 1.00001f);
        ASSERT_LE(error.y, 0x1p-7f * 1.00001f);
        ASSERT_LE(error.z, 0x1p-6f * 1.00001f);
    }
    const vec3 small(0x1p-17f, 0x1p-20f, 0x1p-19f);  // multiples of the smallest steps
    EXPECT_EQ(clvFloatFromR11g11b10(clvR11g11b10FromFloat(small)), small);
}

TEST(R11g11b10, takesAnyInput) {
    EXPECT_EQ(clvFloatFromR11g11b10(clvR11g11b10FromFloat(vec3(-1.0f, kNan, -kInfinity))), vec3(0.0f));
    EXPECT_EQ(clvFloatFromR11g11b10(clvR11g11b10FromFloat(vec3(kInfinity, 1e30f, 65000.0f))), vec3(65024.0f, 65024.0f, 64512.0f));
    EXPECT_TRUE(clvIsFinite(clvFloatFromR11g11b10(~0u)));
}

TEST(HalfDithered, isRightInTheMeanAndNeverFurtherThanAStep) {
    for (float x : {1.0003f, 0.33333f, -711.3f, 3e-5f, 1e-7f, 65503.0f}) {
        const float step = std::abs(x) < 0x1p-14f ? 0x1p-24f : std::ldexp(1.0f, std::ilogb(x) - 10);
        const uint count = 1u << 18;
        double sum = 0.0;
        for (uint k = 0; k < count; ++k) {
            const float rounded = clvFloatFromHalf(clvHalfDithered(x, clvHash(k)));
            ASSERT_LE(std::abs(rounded - x), step) << x;
            sum += rounded;
        }
        EXPECT_NEAR(sum / count, x, 4.0 * 0.5 * step / std::sqrt(double(count))) << x;
    }
    for (uint code : {0x0000u, 0x0001u, 0x3c00u, 0x7bffu, 0xc123u}) EXPECT_EQ(clvHalfDithered(clvFloatFromHalf(code), ~0u), code);
    EXPECT_EQ(clvHalfDithered(kNan, ~0u), clvHalfFromFloat(kNan));
    EXPECT_EQ(clvHalfDithered(kInfinity, ~0u), 0x7bffu);
}

}  // namespace
