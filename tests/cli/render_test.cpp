// clv render from outside: its pictures, its errors, its table of stages.
#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "cli/run_command.h"
#include "support/temporary_folder.h"

namespace {

using namespace clv;
using nlohmann::json;
using Arguments = std::vector<std::string>;

class Render : public TemporaryFolder {
protected:
    CommandResult render(const Arguments& more) const {
        Arguments all = {"render", "--scene", "cornell", "--width", "48", "--rays", "64k", "--samples", "4", "--error-samples", "64", "--out", file("out")};
        all.insert(all.end(), more.begin(), more.end());
        return runCommand(all);
    }
};

TEST_F(Render, writesEveryPictureInBothFormatsAndTheErrorMap) {
    const CommandResult result = render({"--json"});
    ASSERT_EQ(result.status, 0) << result.err;
    const json report = json::parse(result.out);
    const Arguments expected = {"combined.exr", "combined.png", "direct.exr", "direct.png", "error.png", "indirect.exr", "indirect.png", "reference.exr", "reference.png"};
    EXPECT_EQ(listing("out"), expected);
    Arguments said = report.at("files");
    std::ranges::sort(said);
    EXPECT_EQ(said, expected);
    EXPECT_EQ(report.at("size")[0], 48);
    // The reference's own noise is part of the error here, hence wide bounds.
    EXPECT_GT(report.at("errors").at("relative_rmse"), 0.0);
    EXPECT_LT(report.at("errors").at("relative_rmse"), 0.5);
    EXPECT_LT(std::abs(report.at("errors").at("bias").get<double>()), 0.05);
    EXPECT_GT(report.at("errors").at("relative_standard_error"), 0.0);
    EXPECT_LE(report.at("rays"), (64 << 10) + 8);
    EXPECT_GT(report.at("stages").at("inject_ms"), 0.0);
}

TEST_F(Render, printsTheStagesALineEachForPeople) {
    const CommandResult result = render({});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_NE(result.out.find("\nstages\n  setup_ms "), std::string::npos) << result.out;
    for (const char* line : {"\n  rsm_ms ", "\n  inject_ms ", "\nlevels\n  resolution  weight\n", "\n  relative_rmse ", "\nframe_ms "})
        EXPECT_NE(result.out.find(line), std::string::npos) << line << " is not in\n" << result.out;
}

TEST_F(Render, aCameraThatDoesNotExistIsRefusedAndNothingIsWritten) {
    const CommandResult result = render({"--camera", "balcony"});
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
    EXPECT_NE(result.err.find("balcony"), std::string::npos);
    EXPECT_TRUE(listing().empty());
}

}  // namespace
