// Figures of repeated measurements, against tables and hand-computed data.
#include "benchmarks/report/statistics.h"

#include <cmath>

#include <gtest/gtest.h>

namespace {

using namespace clv;

TEST(Statistics, studentQuantilesAreThoseOfTheTables) {
    EXPECT_NEAR(studentQuantile(0.95, 1), 12.7062, 1e-4);
    EXPECT_NEAR(studentQuantile(0.95, 2), 4.3027, 1e-4);
    EXPECT_NEAR(studentQuantile(0.95, 3), 3.1824, 1e-4);
    EXPECT_NEAR(studentQuantile(0.95, 10), 2.2281, 1e-4);
    EXPECT_NEAR(studentQuantile(0.99, 7), 3.4995, 1e-4);
    EXPECT_TRUE(std::isinf(studentQuantile(0.95, 0)));
}

TEST(Statistics, medianAndMiddleHalfIgnoreWhatIsFarOut) {
    EXPECT_EQ(median({}), 0.0);
    EXPECT_EQ(median({3, 1, 1000, 2, 4}), 3.0);
    EXPECT_EQ(middleHalf({3, 1, 1000, 2, 4}), 2.0);
    EXPECT_EQ(middleHalf({7}), 0.0);
}

TEST(Statistics, aRootMeanSquareHasAnIntervalFromTheSpreadOfTheSquares) {
    const RootMeanSquare same = rootMeanSquare({0.2, 0.2, 0.2});
    EXPECT_NEAR(same.value, 0.2, 1e-12);
    EXPECT_NEAR(same.interval, 0.0, 1e-12);
    // Squares 1 and 9: mean 5, standard error 4; the quantile of one degree of freedom.
    const RootMeanSquare two = rootMeanSquare({1.0, 3.0});
    EXPECT_NEAR(two.value, std::sqrt(5.0), 1e-12);
    EXPECT_NEAR(two.interval, 12.7062 * 4.0 / (2.0 * std::sqrt(5.0)), 1e-3);
    EXPECT_TRUE(std::isinf(rootMeanSquare({0.1}).interval));
    EXPECT_EQ(rootMeanSquare({0.0, 0.0}).interval, 0.0);
}

TEST(Statistics, powerLawsAreFittedWithTheirInterval) {
    const std::vector<double> x = {1, 2, 4, 8};
    EXPECT_NEAR(fitPowerLaw(x, std::vector<double>{3, 12, 48, 192}).exponent, 2.0, 1e-12);
    EXPECT_NEAR(fitPowerLaw(x, std::vector<double>{3, 12, 48, 192}).factor, 3.0, 1e-12);
    EXPECT_NEAR(fitPowerLaw(x, std::vector<double>{3, 12, 48, 192}).interval, 0.0, 1e-6);
    // Logarithms to base 2: x 0 1 2 3, y 1 1 3 3. Slope 0.8, residuals 0.2 -0.6 0.6 -0.2: 0.8 over two degrees of freedom and a spread of 5.
    const PowerLaw law = fitPowerLaw(x, std::vector<double>{2, 2, 8, 8});
    EXPECT_NEAR(law.exponent, 0.8, 1e-12);
    EXPECT_NEAR(law.interval, 4.3027 * std::sqrt(0.4 / 5.0), 1e-3);
    EXPECT_TRUE(std::isinf(fitPowerLaw(std::vector<double>{1, 2}, std::vector<double>{1, 2}).interval));
}

}  // namespace
