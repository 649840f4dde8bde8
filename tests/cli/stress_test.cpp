// clv stress: every case holds, a failure is seen, and the command says so.
#include <cstdio>
#include <set>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "bindings/cli/exit_status.h"
#include "bindings/cli/stress/stress_run.h"
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
    EXPECT_FALSE((StressFigure{"", HUGE_VAL}.holds()));
    EXPECT_TRUE((StressFigure{"", 1e300}.holds()));
    EXPECT_TRUE(std::isnan(largerOf(0.0, std::nan(""))) && std::isnan(largerOf(std::nan(""), 1.0)));
    EXPECT_EQ(largerOf(1.0, 2.0), 2.0);
    EXPECT_EQ(largerOf(2.0, 1.0), 2.0);
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
            EXPECT_NEAR(figure.at("value"), 8.5, 1.0);
        } else if (figure.at("name") == "float32 (the default), % short") {
            EXPECT_LE(figure.at("value"), figure.at("at_most"));
        }
    }
    const CommandResult text = runCommand({"stress", "--only", "stall at a weight of 0.005"});
    EXPECT_NE(text.out.find("1 of 1 cases hold"), std::string::npos);
}

// What the command prints and throws for these cases; and the exit status that this comes to.
struct Stressed {
    std::string out, err;
    int status = -1;
};
Stressed stress(std::vector<StressCase> cases, bool json = false) {
    CLI::App app("", "clv");
    const char* const arguments[] = {"clv"};
    CommonOptions common;
    common.json = json;
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    Stressed stressed;
    stressed.status = exitStatusOf(app, 1, arguments, [&] { runStress(cases, {.exhaustive = false, .seed = 1, .parallelFor = serialFor()}, common, Report::object()); });
    std::fflush(stdout);
    stressed.out = testing::internal::GetCapturedStdout(), stressed.err = testing::internal::GetCapturedStderr();
    return stressed;
}
const StressCase kGood{"some", "good", "it holds", [](const StressSettings&) { return std::vector<StressFigure>{{"error", 0.5, 1.0}}; }};
const StressCase kBad{"some", "bad", "it would hold", [](const StressSettings&) { return std::vector<StressFigure>{{"error", 2.0, 1.0}}; }};
const StressCase kBroken{"others", "broken", "it would run", [](const StressSettings&) -> std::vector<StressFigure> { throw std::runtime_error("out of order"); }};

TEST(StressCommand, endsWellWhereAllCasesHold) {
    const Stressed stressed = stress({kGood});
    EXPECT_EQ(stressed.status, 0);
    EXPECT_EQ(stressed.err, "");
    EXPECT_NE(stressed.out.find("holds some: good"), std::string::npos);
}

TEST(StressCommand, failsWhereACaseDoesNotHoldOrCannotRun) {
    const Stressed stressed = stress({kGood, kBad, kBroken});
    EXPECT_EQ(stressed.status, 1);
    EXPECT_EQ(stressed.err, "clv: 2 of 3 cases do not hold\n");
    EXPECT_NE(stressed.out.find("FAILS some: bad"), std::string::npos) << stressed.out;
    EXPECT_NE(stressed.out.find("(at most 1: FAILS)"), std::string::npos) << stressed.out;
    EXPECT_NE(stressed.out.find("out of order"), std::string::npos) << stressed.out;
    // A line a group at the end.
    EXPECT_NE(stressed.out.find("group        | cases |  hold |      s\nsome         |     2 |     1 |"), std::string::npos) << stressed.out;
    EXPECT_NE(stressed.out.find("\nothers       |     1 |     0 |"), std::string::npos) << stressed.out;
    EXPECT_NE(stressed.out.find("1 of 3 cases hold"), std::string::npos) << stressed.out;
}

TEST(StressCommand, reportsFailuresInJson) {
    const Stressed stressed = stress({kBad, kBroken}, true);
    EXPECT_EQ(stressed.status, 1);
    const Json report = Json::parse(stressed.out);
    EXPECT_EQ(report.at("held"), 0);
    EXPECT_EQ(report.at("failed"), 2);
    EXPECT_FALSE(report["cases"][0].at("holds").get<bool>());
    EXPECT_FALSE(report["cases"][0]["figures"][0].at("holds").get<bool>());
    EXPECT_EQ(report["cases"][1].at("error"), "out of order");
}

TEST(StressCommand, refusesAnUnknownCaseInOneLine) {
    const CommandResult result = runCommand({"stress", "--only", "nonsense"});
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.err, "clv stress: --only nonsense: no case has this name or group\n");
}

}  // namespace
