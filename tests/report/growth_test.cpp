// Exponents from the names and times of runs.
#include "benchmarks/report/growth.h"

#include <cmath>

#include <gtest/gtest.h>

namespace {

using namespace clv;

TEST(Growth, eachParameterThatVariesHasItsExponent) {
    std::vector<TimedRun> runs;
    for (const double rays : {1000, 4000, 16000}) {
        for (const double cells : {16, 32, 64}) {
            runs.push_back({"inject/room/rays:" + std::to_string(int(rays)) + "/cells:" + std::to_string(int(cells)) + "/sh1", 1e-9 * rays * std::sqrt(cells)});
        }
    }
    const auto growths = growthsOf(runs);
    ASSERT_EQ(growths.size(), 6u);
    for (const Growth& growth : growths) {
        const bool ofRays = growth.name.find("rays:*") != std::string::npos;
        EXPECT_NEAR(growth.law.exponent, ofRays ? 1.0 : 0.5, 1e-9) << growth.name;
        EXPECT_NEAR(growth.law.interval, 0.0, 1e-6);
    }
    EXPECT_EQ(growths[0].name, "inject/room/rays:*/cells:16/sh1");
    EXPECT_EQ(growths[1].name, "inject/room/rays:1000/cells:*/sh1");
}

TEST(Growth, whatStandsStillOrIsNoNumberHasNone) {
    EXPECT_TRUE(growthsOf(std::vector<TimedRun>{{"merge/32/room", 1.0}, {"merge/64/room", 2.0}, {"trace/way:fast", 1.0}, {"trace/way:slow", 1.0}, {"trace/rays:8", 1.0}}).empty());
}

TEST(Growth, repetitionsCountByTheirMedian) {
    const auto growths = growthsOf(
        std::vector<TimedRun>{{"frame/threads:1", 4.0}, {"frame/threads:1", 90.0}, {"frame/threads:1", 1.0}, {"frame/threads:2", 2.0}, {"frame/threads:4", 1.0}});
    ASSERT_EQ(growths.size(), 1u);
    EXPECT_NEAR(growths[0].law.exponent, -1.0, 1e-12);
    EXPECT_NEAR(growths[0].law.interval, 0.0, 1e-6);
}

TEST(Growth, ofTwoValuesTheSpreadOfRepetitionsGivesTheInterval) {
    std::vector<TimedRun> runs;
    for (const double factor : {0.9, 1.0, 1.1}) runs.push_back({"frame/threads:1", factor}), runs.push_back({"frame/threads:2", 0.5 * factor});
    const auto growths = growthsOf(runs);
    ASSERT_EQ(growths.size(), 1u);
    EXPECT_NEAR(growths[0].law.exponent, -1.0, 1e-12);
    // Both standard deviations of the logarithm are s: the slope's is s sqrt(2 / 3) / ln 2, of four degrees of freedom.
    const double mean = (std::log(0.9) + std::log(1.1)) / 3.0;
    const double variance = (std::pow(std::log(0.9) - mean, 2.0) + mean * mean + std::pow(std::log(1.1) - mean, 2.0)) / 2.0;
    EXPECT_NEAR(growths[0].law.interval, studentQuantile(0.95, 4) * std::sqrt(variance * 2.0 / 3.0) / std::log(2.0), 1e-9);
    runs.resize(2);
    EXPECT_TRUE(std::isinf(growthsOf(runs)[0].law.interval)) << "two times tell nothing of their error";
}

}  // namespace
