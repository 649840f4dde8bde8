// Two halves of the rays judge levels whose bias and noise are known here.
#include <gtest/gtest.h>

#include "clv/cpu/resolution.h"
#include "support/chi_square.h"

namespace clv::test {
namespace resolution_test {

constexpr std::size_t kReceivers = 20000;

// About standard normal: the sum of twelve uniform numbers, less its mean (its variance is 1 exactly).
float noiseAt(uint seed, std::size_t index) {
    float sum = -6.0f;
    for (uint k = 0; k < 12; ++k) sum += randomUnit(seed, uint(index) * 12 + k);
    return sum;
}

// Receivers whose truth is 1; bias alternates in sign from receiver to receiver, noise differs from half to half.
HalfEstimates levelWith(float bias, float noiseOfHalf, uint seed, std::size_t receivers = kReceivers) {
    HalfEstimates level;
    for (uint half = 0; half < 2; ++half) {
        for (std::size_t i = 0; i < receivers; ++i) {
            const float value = 1.0f + (i % 2 == 0 ? bias : -bias);
            const auto noise = [&](std::size_t c) { return noiseOfHalf * noiseAt(seed + half, 3 * i + c); };
            level.half[half].push_back(vec3(value + noise(0), value + noise(1), value + noise(2)));
        }
    }
    return level;
}

TEST(Resolution, theCoarsestIsTriedWithFewRaysAlone) {
    EXPECT_EQ(resolutionsFor(65536.0).front(), 8);
    EXPECT_EQ(resolutionsFor(4e6).front(), 16);
    EXPECT_EQ(resolutionsFor(65536.0, kClvLookupTrilinear).front(), 16);
    EXPECT_EQ(resolutionsFor(4e6).back(), resolutionsFor(1.0).back());
}

TEST(Resolution, halvesTellBiasFromNoise) {
    const std::vector<HalfEstimates> levels = {levelWith(0.3f, 0.1f, 10), levelWith(0.1f, 0.2f, 20), levelWith(0.0f, 0.4f, 30)};
    const LevelErrors errors = judgeLevels(levels);
    ASSERT_EQ(errors.count, 3);
    const double bias[] = {0.3, 0.1, 0.0}, noise[] = {0.1, 0.2, 0.4};
    // Sixty thousand values: the means of products stray by about noise^2 / sqrt(60000).
    constexpr double kSlack = 0.005;
    for (int l = 0; l < 3; ++l) {
        // The mean of two halves has half the variance of one.
        EXPECT_NEAR(errors.noise[l][l], noise[l] * noise[l] / 2.0, kSlack) << l;
        EXPECT_NEAR(errors.bias[l][l], bias[l] * bias[l], kSlack) << l;
        const LevelMix alone = [&] { LevelMix mix{}; mix[l] = 1.0; return mix; }();
        EXPECT_NEAR(errors.meanSquare(alone), errors.bias[l][l] + errors.noise[l][l], 1e-12);
    }
    EXPECT_NEAR(errors.bias[0][1], 0.03, kSlack);
    EXPECT_NEAR(errors.noise[0][1], 0.0, kSlack);
    EXPECT_EQ(errors.bias[0][1], errors.bias[1][0]);
}

TEST(Resolution, moreRaysCutTheNoiseButNotTheBias) {
    const std::vector<HalfEstimates> levels = {levelWith(0.3f, 0.1f, 10), levelWith(0.0f, 0.4f, 20)};
    const LevelErrors now = judgeLevels(levels), later = now.withRays(std::vector<double>{4.0, 16.0});
    EXPECT_DOUBLE_EQ(later.noise[0][0], now.noise[0][0] / 4.0);
    EXPECT_DOUBLE_EQ(later.noise[1][1], now.noise[1][1] / 16.0);
    EXPECT_DOUBLE_EQ(later.noise[0][1], now.noise[0][1] / 8.0);
    EXPECT_EQ(later.bias, now.bias);
}

LevelErrors diagonal(std::vector<double> bias, std::vector<double> noise) {
    LevelErrors errors;
    errors.count = int(bias.size());
    for (int l = 0; l < errors.count; ++l) errors.bias[l][l] = bias[l], errors.noise[l][l] = noise[l];
    return errors;
}

// Levels that err the same way, W/m^2, each by an amount of its own, against a finest one without bias.
LevelErrors alike(std::vector<double> bias, std::vector<double> noise) {
    LevelErrors errors = diagonal(std::vector<double>(bias.size(), 0.0), std::move(noise));
    for (int l = 0; l < errors.count; ++l)
        for (int m = 0; m < errors.count; ++m) errors.bias[l][m] = bias[l] * bias[m];
    return errors;
}

TEST(Resolution, theLevelThatErrsLeastIsTheBest) {
    EXPECT_EQ(bestLevel(alike({2.0, 1.0, 0.0}, {0.1, 1.0, 3.0})), 1);
    EXPECT_EQ(bestLevel(alike({2.0, 1.0, 0.0}, {0.1, 1.0, 1.5})), 2);
    EXPECT_EQ(bestLevel(alike({0.5, 0.2, 0.0}, {0.1, 1.0, 3.0})), 0);
}

TEST(Resolution, noiseOfAFinerLevelLeavesTheBiasBetweenCoarseOnesAlone) {
    const std::vector<HalfEstimates> two = {levelWith(0.3f, 0.1f, 10), levelWith(0.1f, 0.2f, 20)};
    const std::vector<HalfEstimates> three = {two[0], two[1], levelWith(0.0f, 40.0f, 30)};
    EXPECT_NEAR(judgeLevels(three).biasBetween(0, 1), judgeLevels(two).biasBetween(0, 1), 1e-3);
    EXPECT_NEAR(judgeLevels(two).biasBetween(0, 1), 0.2 * 0.2, 0.005);
}

TEST(Resolution, neighboursThatErrLittleMoreStayInPlay) {
    // The second level is the best; the first errs four times as much, the third half more, and the last is no neighbour.
    const LevelErrors errors = alike({2.0, 0.0, 0.0, 0.0}, {0.1, 1.0, 1.5, 9.0});
    ASSERT_EQ(bestLevel(errors), 1);
    EXPECT_FALSE(staysInPlay(errors, 0));
    EXPECT_TRUE(staysInPlay(errors, 1));
    EXPECT_TRUE(staysInPlay(errors, 2));
    EXPECT_FALSE(staysInPlay(errors, 3));
    EXPECT_TRUE(staysInPlay(alike({1.0, 0.0}, {0.1, 1.0}), 0));
}

TEST(Resolution, independentLevelsMixByTheInverseOfTheirErrors) {
    const LevelMix mix = bestMix(diagonal({0.0, 0.0, 0.0}, {1.0, 2.0, 4.0}));
    EXPECT_NEAR(mix[0], 4.0 / 7.0, 1e-12);
    EXPECT_NEAR(mix[1], 2.0 / 7.0, 1e-12);
    EXPECT_NEAR(mix[2], 1.0 / 7.0, 1e-12);
}

TEST(Resolution, noWeightIsNegativeAndTheirSumIsOne) {
    // Noise so alike that the free optimum would subtract the noisier level.
    LevelErrors errors = diagonal({0.0, 0.0}, {1.0, 4.0});
    errors.noise[0][1] = errors.noise[1][0] = 1.9;
    const LevelMix mix = bestMix(errors);
    EXPECT_EQ(mix[0], 1.0);
    EXPECT_EQ(mix[1], 0.0);
}

TEST(Resolution, darknessIsShownByTheFinestLevel) {
    const std::vector<HalfEstimates> dark(3, levelWith(0.0f, 0.0f, 1, 16));
    EXPECT_EQ(bestMix(judgeLevels(dark))[2], 1.0);
}

TEST(Resolution, levelsOfHardlyAnyWeightAreLeftOut) {
    const LevelMix mix = bestMix(diagonal({0.0, 0.0}, {1.0, 99.0}));
    EXPECT_EQ(mix[0], 1.0);
    EXPECT_EQ(mix[1], 0.0);
}

TEST(Resolution, aPartOfTheLevelsIsJudgedAgainstItsOwnFinest) {
    const std::vector<HalfEstimates> levels = {levelWith(0.3f, 0.1f, 10), levelWith(0.1f, 0.2f, 20), levelWith(0.0f, 0.4f, 30)};
    const LevelErrors part = judgeLevels(levels).between(0, 1), alone = judgeLevels(std::span(levels).first(2));
    ASSERT_EQ(part.count, 2);
    for (int l = 0; l < 2; ++l) {
        for (int m = 0; m < 2; ++m) {
            EXPECT_NEAR(part.bias[l][m], alone.bias[l][m], 1e-6) << l << m;
            EXPECT_DOUBLE_EQ(part.noise[l][m], alone.noise[l][m]) << l << m;
        }
    }
}

TEST(Resolution, whatIsShownIsTheBestLevelAndItsNeighbours) {
    // The coarse level is biased beyond use: nothing to gain.
    EXPECT_EQ(chooseLevels(judgeLevels(std::vector<HalfEstimates>{levelWith(2.0f, 0.1f, 10), levelWith(0.0f, 0.2f, 20)}))[1], 1.0);
    // Two levels of equal, independent noise: the mean of both halves the squared error.
    const LevelMix both = chooseLevels(judgeLevels(std::vector<HalfEstimates>{levelWith(0.0f, 0.3f, 30), levelWith(0.0f, 0.3f, 40)}));
    EXPECT_NEAR(both[0], 0.5, 0.02);
    EXPECT_NEAR(both[0] + both[1], 1.0, 1e-12);
    // The third level would help, but it is no neighbour of the best.
    const LevelMix near = chooseLevels(diagonal({0.0, 0.0, 0.0}, {1.0, 2.0, 2.0}));
    EXPECT_NEAR(near[0], 2.0 / 3.0, 1e-12);
    EXPECT_NEAR(near[1], 1.0 / 3.0, 1e-12);
    EXPECT_EQ(near[2], 0.0);
}

TEST(Resolution, raysToComeFavourTheFinerLevel) {
    const LevelErrors now = judgeLevels(std::vector<HalfEstimates>{levelWith(0.2f, 0.02f, 10), levelWith(0.0f, 0.9f, 20)});
    EXPECT_GT(chooseLevels(now)[0], 0.9);
    EXPECT_GT(chooseLevels(now.withRays(std::vector<double>(2, 1000.0)))[1], 0.9);
}

}  // namespace resolution_test
}  // namespace clv::test
