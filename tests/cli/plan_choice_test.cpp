// clv plan with a budget or a wanted error: promises by a kept model, and what became of them.
#include <algorithm>
#include <fstream>
#include <iterator>

#include <nlohmann/json.hpp>

#include "benchmarks/report/checksum.h"
#include "bindings/cli/model_cache.h"
#include "cli/run_command.h"
#include "support/temporary_folder.h"

namespace {

using namespace clv;

class PlanChoice : public TemporaryFolder {
protected:
    // A model of this machine stands ready, so that none is measured.
    void SetUp() override {
        TemporaryFolder::SetUp();
        Checksum program;
        const std::string bytes = read(CLV_BINARY_DIR "/clv");
        program.add(bytes);
        char text[17];
        std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(program.value()));
        nlohmann::json key = modelKey(2, 3000.0);
        key["program"] = text;
        ModelCache(file("cache/clv")).keep(key, CostModel::fromJson({{"time_growth", 0.0}, {"noise_fall", -0.5}, {"seconds_factor", 1.5}, {"error_factor", 1.25}}));
        setenv("XDG_CACHE_HOME", file("cache").c_str(), 1);
    }
    void TearDown() override {
        unsetenv("XDG_CACHE_HOME");
        TemporaryFolder::TearDown();
    }
    static CommandResult plan(std::vector<std::string> more) {
        std::vector<std::string> all = {"plan", "--scene", "furnace_box", "--resolution", "16", "--points", "100", "--threads", "2", "--json"};
        all.insert(all.end(), more.begin(), more.end());
        return runCommand(all);
    }
};

TEST_F(PlanChoice, aWantedErrorIsPromisedAndReachedWithinAHalf) {
    const CommandResult result = plan({"--target-error", "0.05"});
    ASSERT_EQ(result.status, 0) << result.err;
    const auto report = nlohmann::json::parse(result.out);
    EXPECT_EQ(report.at("promised").at("resolution"), 16) << "the one that was asked for";
    EXPECT_EQ(report.at("model"), "kept from an earlier run");
    const auto& promised = report.at("promised");
    EXPECT_LE(promised.at("relative_rmse"), 0.05);
    EXPECT_NEAR(promised.at("relative_rmse_95_percent")[1].get<double>() / promised.at("relative_rmse").get<double>(), 1.25, 1e-9);
    EXPECT_NEAR(promised.at("ms").get<double>() / promised.at("ms_95_percent")[0].get<double>(), 1.5, 1e-9);
    EXPECT_NEAR(report.at("measured").at("relative_rmse_over_promised"), 1.0, 0.5);
    EXPECT_GT(report.at("measured").at("ms"), 0.0);
}

TEST_F(PlanChoice, whatCannotBeHadIsRefusedWithWhatCan) {
    for (const auto& [option, value] : {std::pair{"--budget-ms", "1e-6"}, {"--target-error", "1e-6"}}) {
        const CommandResult result = plan({option, value});
        EXPECT_EQ(result.status, 2);
        EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
        EXPECT_NE(result.err.find(std::string(option) + " 1e-06: expected at least"), std::string::npos) << result.err;
    }
    EXPECT_EQ(plan({"--budget-ms", "5", "--target-error", "0.1"}).status, 2);
    const CommandResult percent = plan({"--target-error", "20"});
    EXPECT_EQ(percent.status, 2);
    EXPECT_NE(percent.err.find("at most 1"), std::string::npos) << percent.err;
    EXPECT_EQ(plan({"--budget-ms", "0"}).status, 2);
    EXPECT_EQ(plan({"--budget-ms", "5", "--points", "0"}).status, 2);
}

TEST_F(PlanChoice, aPromiseAloneRunsNothing) {
    const CommandResult result = plan({"--budget-ms", "1000", "--promise-only"});
    ASSERT_EQ(result.status, 0) << result.err;
    const auto report = nlohmann::json::parse(result.out);
    EXPECT_LE(report.at("promised").at("ms"), 1000.0);
    EXPECT_FALSE(report.contains("measured"));
}

}  // namespace
