// The core in a user's build with -ffast-math, in which compilers take it that no number is NaN or infinite: its stiff and extreme cases hold.
#include <gtest/gtest.h>

#include "bindings/cli/stress/stress_case.h"
#include "clv/plan/number_check.h"

namespace {

using namespace clv;

class FastMath : public testing::TestWithParam<StressCase> {};

TEST_P(FastMath, holds) {
    const auto figures = GetParam().run({.exhaustive = false, .seed = 5, .parallelFor = serialFor()});
    ASSERT_FALSE(figures.empty());
    for (const StressFigure& figure : figures) {
        EXPECT_TRUE(isFinite(figure.value) && figure.holds()) << figure.name << ": " << figure.value << ", at most " << figure.atMost;
    }
}

std::vector<StressCase> casesOfTheCore() {
    std::vector<StressCase> all;
    for (auto group : {historyCases, walkCases, fluxCases, gridCases, propertyCases, precisionCases}) {
        for (StressCase& one : group()) all.push_back(std::move(one));
    }
    return all;
}

std::string nameOf(const testing::TestParamInfo<StressCase>& info) {
    std::string name = info.param.group + "_" + info.param.name;
    for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    return name;
}
INSTANTIATE_TEST_SUITE_P(Stress, FastMath, testing::ValuesIn(casesOfTheCore()), nameOf);

}  // namespace
