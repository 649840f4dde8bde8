// Errors of hand-computed data.
#include "benchmarks/report/metrics.h"

#include <cmath>

#include <gtest/gtest.h>

namespace {

using namespace clv;
using Values = std::vector<glm::vec3>;

TEST(Metrics, aPerfectEstimateHasNoError) {
    const Values truth = {{1, 2, 3}, {0, 0, 0}, {5, 0, 1}};
    const ErrorSummary summary = summarizeErrors(truth, truth);
    EXPECT_EQ(summary.relativeRmse, 0.0);
    EXPECT_EQ(summary.bias, 0.0);
    EXPECT_EQ(summary.p95, 0.0);
}

TEST(Metrics, relativeRmseAndBiasAreOverPointsAndChannels) {
    // mean T = 2; differences 1, -1, 0, 0, 3, 0: squares 11, sum 3.
    const Values truth = {{1, 2, 3}, {2, 2, 2}}, estimate = {{2, 1, 3}, {2, 5, 2}};
    const ErrorSummary summary = summarizeErrors(estimate, truth);
    EXPECT_NEAR(summary.relativeRmse, std::sqrt(11.0 / 6.0) / 2.0, 1e-12);
    EXPECT_NEAR(summary.bias, (3.0 / 6.0) / 2.0, 1e-12);
}

TEST(Metrics, biasKeepsItsSign) {
    const Values truth(4, glm::vec3(2.0f)), estimate(4, glm::vec3(1.5f));
    EXPECT_NEAR(summarizeErrors(estimate, truth).bias, -0.25, 1e-12);
}

TEST(Metrics, pointErrorsAreLengthsOverTheLengthOfTheTruth) {
    const Values truth = {{3, 4, 0}, {0, 0, 5}}, estimate = {{3, 4, 1}, {3, 4, 5}};
    const std::vector<float> errors = pointErrors(estimate, truth);
    ASSERT_EQ(errors.size(), 2u);
    EXPECT_NEAR(errors[0], 0.2f, 1e-6f);
    EXPECT_NEAR(errors[1], 1.0f, 1e-6f);
}

TEST(Metrics, darkPointsAreMeasuredAgainstATwentiethOfTheMean) {
    // mean |T| = 10, so the dark point counts against 0.5.
    const Values truth = {{0, 20, 0}, {0, 0, 0}}, estimate = {{0, 20, 0}, {0.25f, 0, 0}};
    EXPECT_NEAR(pointErrors(estimate, truth)[1], 0.5f, 1e-6f);
}

TEST(Metrics, p95IsTheSmallestErrorThatNinetyFiveInAHundredDoNotExceed) {
    Values truth(100, glm::vec3(1, 0, 0)), estimate;
    for (int i = 1; i <= 100; ++i) estimate.emplace_back(1.0f + 0.01f * float(i), 0, 0);
    EXPECT_NEAR(summarizeErrors(estimate, truth).p95, 0.95, 1e-5);
}

TEST(Metrics, noLightAnywhereIsNoErrorOrAnInfiniteOne) {
    const Values dark(3, glm::vec3(0.0f)), lit(3, glm::vec3(1.0f));
    EXPECT_EQ(summarizeErrors(dark, dark).relativeRmse, 0.0);
    EXPECT_TRUE(std::isinf(summarizeErrors(lit, dark).relativeRmse));
    EXPECT_TRUE(std::isinf(summarizeErrors(lit, dark).p95));
    EXPECT_EQ(summarizeErrors({}, {}).p95, 0.0);
}

TEST(Metrics, leakIsAgainstTheTruthOrTheLitSideWhereTheTruthIsDark) {
    const Values estimate = {{0.2f, 0.2f, 0.2f}, {0.4f, 0.4f, 0.4f}}, truth(2, glm::vec3(0.1f)), dark(2, glm::vec3(0.0f)), lit(5, glm::vec3(30.0f));
    EXPECT_NEAR(leak(estimate, truth, lit), 3.0, 1e-6);
    EXPECT_NEAR(leak(estimate, dark, lit), 0.01, 1e-8);
    EXPECT_EQ(leak(dark, dark, lit), 0.0);
}

}  // namespace
