#include <gtest/gtest.h>

#include <array>
#include <functional>

#include "clv/math/sampling.h"
#include "support/chi_square.h"

using namespace clv;

namespace {

const std::array<vec3, 6> kNormals{vec3(0.0f, 0.0f, 1.0f),  vec3(0.0f, 0.0f, -1.0f),
                                   vec3(1.0f, 0.0f, 0.0f),  vec3(0.0f, -1.0f, 0.0f),
                                   normalize(vec3(1.0f, 2.0f, -3.0f)), normalize(vec3(1e-4f, -1e-4f, -1.0f))};

// Bins of equal solid angle: heights and longitudes about the z axis.
constexpr int kHeights = 15, kTurns = 15, kBins = kHeights * kTurns;

int binOf(vec3 direction) {
    vec2 u = clvSquareFromSphere(direction);
    return std::min(int(u.x * kHeights), kHeights - 1) * kTurns + std::min(int(u.y * kTurns), kTurns - 1);
}

// Draws directions and compares their histogram over the whole sphere with the integral of the density.
double chanceOfDirections(const std::function<vec3(vec2)>& sample, const std::function<double(vec3)>& pdf) {
    constexpr int samples = 200000, sub = 24;
    std::array<double, kBins> counts{}, expected{};
    for (uint i = 0; i < samples; ++i) {
        counts[binOf(sample(vec2(test::randomUnit(1u, 2u * i), test::randomUnit(1u, 2u * i + 1u))))] += 1.0;
    }
    for (int i = 0; i < kHeights * sub; ++i) {
        for (int j = 0; j < kTurns * sub; ++j) {
            vec3 d = clvSphereFromSquare(vec2((i + 0.5f) / (kHeights * sub), (j + 0.5f) / (kTurns * sub)));
            expected[(i / sub) * kTurns + j / sub] += samples * pdf(d) * 4.0 * double(kClvPi) / (kBins * sub * sub);
        }
    }
    // Bins that hardly anything falls into are pooled, since the statistic is only then chi-square distributed.
    double pooledCount = 0.0, pooledExpected = 0.0;
    std::vector<double> c, e;
    for (int i = 0; i < kBins; ++i) {
        if (expected[i] < 20.0) {
            pooledCount += counts[i];
            pooledExpected += expected[i];
        } else {
            c.push_back(counts[i]);
            e.push_back(expected[i]);
        }
    }
    EXPECT_NEAR(pooledCount, pooledExpected, 5.0 * std::sqrt(pooledExpected) + 1.0);
    if (c.size() % 2 == 0) {
        c[0] += c.back(), c.pop_back();
        e[0] += e.back(), e.pop_back();
    }
    return test::chiSquareChance(c, e);
}

TEST(CosSin, isRightToTheLastBitsOfAFloat) {
    for (int i = -4000; i <= 4000; ++i) {
        const float angle = float(i) / 4000.0f * 0.25f * kClvPi;
        const vec2 turn = clvCosSinSmall(angle);
        ASSERT_NEAR(turn.x, std::cos(double(angle)), 1e-7) << angle;
        ASSERT_NEAR(turn.y, std::sin(double(angle)), 1e-7 * std::abs(angle) + 1e-30) << angle;
    }
}

TEST(Basis, isRightHandedAndOrthonormalForAllNormals) {
    for (uint i = 0; i < 100000; ++i) {
        vec3 n = i < kNormals.size() ? kNormals[i] : test::randomDirection(2u, i), t, b;
        clvBasis(n, t, b);
        ASSERT_NEAR(dot(t, t), 1.0f, 1e-6f);
        ASSERT_NEAR(dot(b, b), 1.0f, 1e-6f);
        ASSERT_NEAR(dot(t, b), 0.0f, 1e-6f);
        ASSERT_NEAR(length(cross(t, b) - n), 0.0f, 1e-6f);
    }
}

TEST(Cosine, directionsFollowTheirDensityAroundAnyNormal) {
    for (vec3 n : kNormals) {
        double chance = chanceOfDirections([&](vec2 u) { return clvCosineFromSquare(u, n); },
                                           [&](vec3 d) { return clvCosinePdf(d, n); });
        EXPECT_GT(chance, 1e-3 / kNormals.size());
    }
}

TEST(Cosine, aWrongDensityIsFound) {
    vec3 n = kNormals[4];
    double chance = chanceOfDirections([&](vec2 u) { return clvCosineFromSquare(u, n); },
                                       [&](vec3 d) { return 0.97 * clvCosinePdf(d, n) + 0.03 * clvSpherePdf(); });
    EXPECT_LT(chance, 1e-6);
}

TEST(Cosine, inverseFindsTheSample) {
    for (vec3 n : kNormals) {
        for (uint i = 0; i < 20000; ++i) {
            vec2 u(test::randomUnit(3u, 2u * i), test::randomUnit(3u, 2u * i + 1u));
            vec3 d = clvCosineFromSquare(u, n);
            ASSERT_NEAR(length(d), 1.0f, 1e-6f);
            ASSERT_GE(dot(d, n), -1e-7f);
            ASSERT_NEAR(length(clvSquareFromCosine(d, n) - u), 0.0f, 2e-6f);
        }
    }
}

TEST(Disk, isUniformByArea) {
    constexpr int rings = 9, sectors = 9, samples = 200000;
    std::array<double, rings * sectors> counts{}, expected{};
    expected.fill(samples * double(clvDiskPdf()) * double(kClvPi) / (rings * sectors));
    for (uint i = 0; i < samples; ++i) {
        vec2 p = clvDiskFromSquare(vec2(test::randomUnit(4u, 2u * i), test::randomUnit(4u, 2u * i + 1u)));
        double turn = std::atan2(p.y, p.x) / (2.0 * double(kClvPi)) + 0.5;
        counts[std::min(int(dot(p, p) * rings), rings - 1) * sectors + std::min(int(turn * sectors), sectors - 1)] += 1.0;
    }
    EXPECT_GT(test::chiSquareChance(counts, expected), 1e-3);
}

TEST(Disk, mapsCornersToTheRimAndBack) {
    for (vec2 u : {vec2(0.0f, 0.0f), vec2(0.0f, 1.0f), vec2(1.0f, 0.0f), vec2(1.0f, 1.0f), vec2(0.5f, 1.0f), vec2(0.0f, 0.5f)}) {
        EXPECT_NEAR(length(clvDiskFromSquare(u)), 1.0f, 1e-6f);
        EXPECT_NEAR(length(clvSquareFromDisk(clvDiskFromSquare(u)) - u), 0.0f, 1e-6f);
    }
    EXPECT_EQ(clvDiskFromSquare(vec2(0.5f, 0.5f)), vec2(0.0f, 0.0f));
    EXPECT_EQ(clvSquareFromDisk(vec2(0.0f, 0.0f)), vec2(0.5f, 0.5f));
}

TEST(Sphere, directionsFollowTheirDensity) {
    EXPECT_GT(chanceOfDirections(clvSphereFromSquare, [](vec3) { return double(clvSpherePdf()); }), 1e-3);
}

TEST(Sphere, inverseFindsTheSample) {
    for (uint i = 0; i < 100000; ++i) {
        vec2 u(test::randomUnit(5u, 2u * i), test::randomUnit(5u, 2u * i + 1u));
        vec3 d = clvSphereFromSquare(u);
        ASSERT_NEAR(length(d), 1.0f, 1e-6f);
        vec2 found = clvSquareFromSphere(d);
        ASSERT_NEAR(found.x, u.x, 1e-6f);
        // Near the poles the longitude hardly matters, and a turn is none.
        float off = std::abs(found.y - u.y);
        ASSERT_LT(std::min(off, 1.0f - off) * std::hypot(d.x, d.y), 1e-6f);
    }
}

}  // namespace
