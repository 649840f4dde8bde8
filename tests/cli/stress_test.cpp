// clv stress: every case holds, a failure is seen, and the command says so.
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "bindings/cli/stress/stress_case.h"
#include "bindings/embree/task_pool.h"
#include "cli/run_command.h"

namespace {

using namespace clv;
using Json = nlohmann::json;

class EveryCase : public testing::TestWithParam<StressCase> {};

TEST_P(EveryCase, holds) {
    const auto figures = GetParam().run({.exhaustive = false, .seed = 3, .parallelFor = tbbParallelFor(0)});
    bool bounded = false;
    for (const StressFigure& figure : figures) {
        EXPECT_TRUE(figure.holds()) << figure.name << ": " << figure.value << ", at most " << figure.atMost;
        bounded = bounded || figure.atMost != StressFigure::kStated;
    }
    EXPECT_TRUE(bounded) << "a case that cannot fail";
}

std::string nameOf(const testing::TestParamInfo<StressCase>& info) {
    std::string name = info.param.group + "_" + info.param.name;
    for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    return name;
}
INSTANTIATE_TEST_SUITE_P(Stress, EveryCase, testing::ValuesIn(stressCases()), nameOf);

TEST(StressFigure, boundsHoldUpToThemselvesAndNeverForNan) {
    EXPECT_TRUE((StressFigure{"", 1.0, 1.0}.holds()));
    EXPECT_FALSE((StressFigure{"", 1.1, 1.0}.holds()));
    EXPECT_FALSE((StressFigure{"", std::nan(""), 1.0}.holds()));
    EXPECT_FALSE((StressFigure{"", std::nan("")}.holds()));
    EXPECT_TRUE((StressFigure{"", 1e300}.holds()));
}

TEST(StressCases, haveNamesOfTheirOwn) {
    std::set<std::string> names;
    for (const StressCase& one : stressCases()) EXPECT_TRUE(names.insert(one.group + one.name).second) << one.name;
    EXPECT_GE(names.size(), 50u);
}

TEST(StressCommand, saysWhatWasMeasured) {
    const CommandResult result = runCommand({"stress", "--only", "stall at a weight of 0.005", "--json"});
    ASSERT_EQ(result.status, 0) << result.err;
    const Json report = Json::parse(result.out);
    EXPECT_EQ(report.at("failed"), 0);
    ASSERT_EQ(report.at("cases").size(), 1u);
    const Json& one = report["cases"][0];
    EXPECT_EQ(one.at("group"), "history");
    EXPECT_TRUE(one.at("holds").get<bool>());
    // Known of half precision, rounded to the nearest (relaxation stops where a step is less than half a last place).
    for (const Json& figure : one.at("figures")) {
        if (figure.at("name") == "half, to the nearest, % short") {
            EXPECT_NEAR(figure.at("value"), 7.0, 2.0);
        } else if (figure.at("name") == "float32 (the default), % short") {
            EXPECT_LE(figure.at("value"), figure.at("at_most"));
        }
    }
    const CommandResult text = runCommand({"stress", "--only", "stall at a weight of 0.005"});
    EXPECT_NE(text.out.find("1 of 1 cases hold"), std::string::npos);
}

TEST(StressCommand, refusesAnUnknownCaseInOneLine) {
    const CommandResult result = runCommand({"stress", "--only", "nonsense"});
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.err, "clv stress: --only nonsense: no case has this name or group\n");
}

}  // namespace
