// Interpolation weights and the local linear fit.
#include "clv/stages/evaluate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/chi_square.h"

using namespace clv;

namespace {

TEST(Evaluate, interpolationWeightsAddUpToOneWhereverTheyAreCentred) {
    for (uint i = 0; i < 2000; ++i) {
        const vec3 p(test::randomUnit(1, i) - 0.5f, test::randomUnit(2, i) - 0.5f, test::randomUnit(3, i) - 0.5f);
        for (uint lookup : {kClvLookupTrilinear, kClvLookupLinearFit}) {
            float sum = 0.0f;
            vec3 mean(0.0f);
            for (int k = 0; k < 27; ++k) {
                const vec3 offset = vec3(float(k % 3 - 1), float(k / 3 % 3 - 1), float(k / 9 - 1)) - p;
                const float weight = clvLookupWeight(lookup, offset);
                ASSERT_GE(weight, 0.0f);
                sum += weight;
                mean += weight * offset;
            }
            ASSERT_NEAR(sum, 1.0f, 1e-6f);
            // Both reproduce a linear field by themselves.
            ASSERT_LT(length(mean), 1e-6f);
        }
    }
}

TEST(Evaluate, irradianceIsANumberWhateverWasRead) {
    const float infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(clvIrradianceFromSum(2.5f), 2.5f);
    EXPECT_EQ(clvIrradianceFromSum(-2.5f), 0.0f);
    EXPECT_EQ(clvIrradianceFromSum(-infinity), 0.0f);
    EXPECT_EQ(clvIrradianceFromSum(infinity), kClvMostIrradiance);
    EXPECT_EQ(clvIrradianceFromSum(infinity - infinity), kClvMostIrradiance);
    EXPECT_TRUE(std::isfinite(clvIrradianceFromSum(infinity) + clvIrradianceFromSum(3e38f)));
}

TEST(Evaluate, theQuadraticWeightIsSmoothWhereItsPiecesMeet) {
    const float step = 1e-3f;
    for (float x : {0.5f, 1.5f, -0.5f, -1.5f}) {
        EXPECT_NEAR(clvQuadraticWeight(x - step), clvQuadraticWeight(x + step), 2.1f * step);
        const float before = clvQuadraticWeight(x) - clvQuadraticWeight(x - step), after = clvQuadraticWeight(x + step) - clvQuadraticWeight(x);
        EXPECT_NEAR(before / step, after / step, 3.0f * step);
    }
    EXPECT_EQ(clvQuadraticWeight(1.6f), 0.0f);
}

struct Samples {
    std::vector<vec3> x;
    std::vector<float> weight, volume;
};

Samples randomSamples(uint seed, int count) {
    Samples s;
    for (uint i = 0; i < uint(count); ++i) {
        s.x.push_back(vec3(test::randomUnit(seed, 5 * i), test::randomUnit(seed, 5 * i + 1), test::randomUnit(seed, 5 * i + 2)) * 3.0f - 1.5f);
        s.weight.push_back(0.1f + test::randomUnit(seed, 5 * i + 3));
        s.volume.push_back(0.2f + test::randomUnit(seed, 5 * i + 4));
    }
    return s;
}

// The value at x = 0 that the fit gives for deposits volume * field(x).
template <class Field>
double fitted(const Samples& s, float ridge, Field&& field) {
    ClvFit fit = clvFitBegin();
    for (std::size_t i = 0; i < s.x.size(); ++i) clvFitAdd(fit, s.weight[i] * s.volume[i], s.x[i]);
    const vec3 slope = clvFitSolve(fit, ridge);
    double value = 0.0;
    for (std::size_t i = 0; i < s.x.size(); ++i) value += double(clvFitShare(fit, slope, s.weight[i], s.x[i])) * s.volume[i] * field(s.x[i]);
    return value;
}

TEST(Evaluate, theFitReproducesAConstantHoweverFewTheSamples) {
    for (uint seed = 0; seed < 50; ++seed) {
        for (float ridge : {kClvFitRidge, 10.0f}) {
            for (int count : {1, 2, 5, 27}) EXPECT_NEAR(fitted(randomSamples(seed, count), ridge, [](const vec3&) { return 7.0; }), 7.0, 5e-4);
        }
    }
}

TEST(Evaluate, theFitReproducesALinearFieldAsTheRidgeGoes) {
    auto field = [](const vec3& x) { return 3.0 + 0.5 * x.x - 1.0 * x.y + 0.25 * x.z; };
    for (uint seed = 0; seed < 50; ++seed) {
        const Samples s = randomSamples(seed, 27);
        EXPECT_NEAR(fitted(s, 1e-5f, field), 3.0, 1e-3) << seed;
        EXPECT_NEAR(fitted(s, kClvFitRidge, field), 3.0, 0.1) << seed;
    }
}

TEST(Evaluate, samplesInAPlaneGiveAFiniteFit) {
    Samples s = randomSamples(3, 9);
    for (vec3& x : s.x) x.z = 0.5f;
    EXPECT_NEAR(fitted(s, kClvFitRidge, [](const vec3& x) { return 2.0 + x.x; }), 2.0, 0.1);
    for (vec3& x : s.x) x = vec3(0.3f, -0.2f, 0.5f);
    EXPECT_NEAR(fitted(s, kClvFitRidge, [](const vec3&) { return 2.0; }), 2.0, 1e-4);
}

TEST(Evaluate, theAmbientTermFillsTheDarkAndFadesOut) {
    const vec3 ambient(0.2f, 0.3f, 0.4f);
    EXPECT_EQ(clvAmbient(vec3(0.0f), ambient, 2.0f), ambient);
    EXPECT_EQ(clvAmbient(vec3(0.0f, 2.0f, 0.0f), ambient, 2.0f), vec3(0.0f));
    EXPECT_EQ(clvAmbient(vec3(9.0f), ambient, 2.0f), vec3(0.0f));
    EXPECT_FLOAT_EQ(clvAmbient(vec3(1.0f, 0.0f, 0.5f), ambient, 2.0f).y, 0.15f);
}

}  // namespace
