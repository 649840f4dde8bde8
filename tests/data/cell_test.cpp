// What the storages hold of a beam, and what they give back.
#include "clv/data/cell.h"

#include <gtest/gtest.h>

#include "support/chi_square.h"

using namespace clv;

namespace {

const uint kStorages[] = {kClvStorageCube, kClvStorageCube9, kClvStorageSh1, kClvStorageSh2};
const vec3 kAxes[] = {vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 1, 0), vec3(0, -1, 0), vec3(0, 0, 1), vec3(0, 0, -1)};

// Irradiance that a storage gives for a beam of 1 W/m^2 along `direction`.
float read(uint storage, vec3 direction, vec3 normal) {
    return clvDotCoefficients(clvReadCoefficients(storage, normal), clvDepositCoefficients(storage, direction));
}

// The cosine lobe's bands: max(0, x) = 1/4 + x/2 + 5/16 P2(x) + ...
double lobe(int bands, double x) { return 0.25 + 0.5 * x + (bands > 1 ? 0.3125 * 0.5 * (3.0 * x * x - 1.0) : 0.0); }

TEST(Cell, cubesReadABeamExactlyOnTheAxes) {
    for (uint storage : {kClvStorageCube, kClvStorageCube9}) {
        for (uint i = 0; i < 2000; ++i) {
            const vec3 d = test::randomDirection(1u, i);
            for (const vec3& n : kAxes) ASSERT_NEAR(read(storage, d, n), std::max(0.0f, -dot(d, n)), 1e-7f);
        }
    }
}

TEST(Cell, sphericalHarmonicsReadTheBandLimitedCosine) {
    for (uint i = 0; i < 5000; ++i) {
        const vec3 d = test::randomDirection(1u, i), n = test::randomDirection(2u, i);
        ASSERT_NEAR(read(kClvStorageSh1, d, n), lobe(1, -dot(d, n)), 1e-6);
        ASSERT_NEAR(read(kClvStorageSh2, d, n), lobe(2, -dot(d, n)), 1e-6);
    }
}

// Radiance 1 + a.w + w.B w (B symmetric without trace) from direction w: its irradiance is pi (1 + 2/3 a.n + 1/4 n.B n).
TEST(Cell, cube9ReadsAFieldOfSecondOrderExactlyOnItsOddAndMixedParts) {
    const vec3 a(0.4f, -0.3f, 0.2f);
    const float xy = 0.25f, yz = -0.2f, xz = 0.15f;
    const int directions = 1 << 18;
    ClvCoefficients sum[4] = {};
    for (int i = 0; i < directions; ++i) {
        // Spherical Fibonacci points: a quadrature of the sphere.
        const double z = 1.0 - (2.0 * i + 1.0) / directions, turn = 2.399963229728653 * i, r = std::sqrt(1.0 - z * z);
        const vec3 w(float(r * std::cos(turn)), float(r * std::sin(turn)), float(z));
        const float radiance = 1.0f + dot(a, w) + 2.0f * (xy * w.x * w.y + yz * w.y * w.z + xz * w.x * w.z);
        for (uint storage : kStorages) {
            const ClvCoefficients f = clvDepositCoefficients(storage, -w);
            const float weight = radiance * 4.0f * kClvPi / float(directions);
            sum[storage].a += f.a * weight, sum[storage].b += f.b * weight, sum[storage].c += f.c * weight;
        }
    }
    double worst[4] = {};
    for (uint i = 0; i < 2000; ++i) {
        const vec3 n = test::randomDirection(3u, i);
        const float truth = kClvPi * (1.0f + 2.0f / 3.0f * dot(a, n) + 0.5f * (xy * n.x * n.y + yz * n.y * n.z + xz * n.x * n.z));
        for (uint storage : kStorages) {
            const double error = clvDotCoefficients(clvReadCoefficients(storage, n), sum[storage]) / truth - 1.0;
            worst[storage] = std::max(worst[storage], std::abs(error));
        }
    }
    EXPECT_LT(worst[kClvStorageCube9], 1e-3);
    EXPECT_LT(worst[kClvStorageSh2], 1e-3);
    EXPECT_GT(worst[kClvStorageCube], 0.03);
    EXPECT_GT(worst[kClvStorageSh1], 0.03);
}

TEST(Cell, everyStorageReadsAConstantFieldAsPiTimesItsRadiance) {
    const int directions = 1 << 12;
    for (uint storage : kStorages) {
        ClvCoefficients sum{};
        for (int i = 0; i < directions; ++i) {
            const double z = 1.0 - (2.0 * i + 1.0) / directions, turn = 2.399963229728653 * i, r = std::sqrt(1.0 - z * z);
            const ClvCoefficients f = clvDepositCoefficients(storage, vec3(float(r * std::cos(turn)), float(r * std::sin(turn)), float(z)));
            const float weight = 4.0f * kClvPi / float(directions);
            sum.a += f.a * weight, sum.b += f.b * weight, sum.c += f.c * weight;
        }
        for (uint i = 0; i < 500; ++i) {
            ASSERT_NEAR(clvDotCoefficients(clvReadCoefficients(storage, test::randomDirection(4u, i)), sum), kClvPi, 1e-3) << storage;
        }
    }
}

TEST(Cell, coefficientsBeyondTheCountAreZero) {
    for (uint storage : kStorages) {
        for (uint i = 0; i < 100; ++i) {
            const vec3 d = test::randomDirection(5u, i);
            for (const ClvCoefficients& c : {clvDepositCoefficients(storage, d), clvReadCoefficients(storage, d)}) {
                const float values[9] = {c.a.x, c.a.y, c.a.z, c.a.w, c.b.x, c.b.y, c.b.z, c.b.w, c.c};
                for (uint k = clvCoefficientCount(storage); k < 9; ++k) ASSERT_EQ(values[k], 0.0f);
            }
        }
    }
}

TEST(Cell, valvesReadingTakesTheSideThatTheNormalPointsTo) {
    const ClvCoefficients sides = clvDepositCoefficients(kClvStorageCube, vec3(0.0f, -1.0f, 0.0f));
    EXPECT_FLOAT_EQ(clvDotCoefficients(clvReadCoefficientsSquared(vec3(0.0f, 1.0f, 0.0f)), sides), 1.0f);
    EXPECT_FLOAT_EQ(clvDotCoefficients(clvReadCoefficientsSquared(vec3(0.6f, 0.8f, 0.0f)), sides), 0.64f);
    EXPECT_FLOAT_EQ(clvDotCoefficients(clvReadCoefficientsSquared(vec3(0.6f, -0.8f, 0.0f)), sides), 0.0f);
}

}  // namespace
