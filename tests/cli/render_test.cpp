// clv render from outside: its pictures, its errors, its table of stages.
#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "bindings/scene/file_bytes.h"
#include "bindings/scene/glb_container.h"
#include "cli/run_command.h"
#include "support/temporary_folder.h"

namespace {

using namespace clv;
using nlohmann::json;
using Arguments = std::vector<std::string>;

class Render : public TemporaryFolder {
protected:
    CommandResult render(const Arguments& more) const {
        Arguments all = {"render", "--width", "48", "--rays", "64k", "--samples", "4", "--error-samples", "64", "--out", file("out")};
        all.insert(all.end(), more.begin(), more.end());
        if (std::ranges::find(more, "--scene") == more.end()) all.insert(all.end(), {"--scene", "cornell"});
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

TEST_F(Render, aPictureWhoseHeightFollowsFromTheFileStaysWithinTheLimits) {
    ASSERT_EQ(runCommand({"scenes", "--write", file("cornell.glb")}).status, 0);
    GlbParts parts = unpackGlb("cornell.glb", readFileBytes(file("cornell.glb")));
    for (const double aspect : {1e-4, 1e-44, 1e38}) {
        for (json& camera : parts.document["cameras"]) camera["perspective"]["aspectRatio"] = aspect;
        writeFileBytes(file("slender.glb"), packGlb(parts.document, *parts.binary));
        const CommandResult result = render({"--scene", file("slender.glb")});
        EXPECT_EQ(result.status, 2);
        EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
        EXPECT_NE(result.err.find("slender.glb: camera"), std::string::npos) << result.err;
        EXPECT_NE(result.err.find("1 to 16384 rows"), std::string::npos) << result.err;
        EXPECT_EQ(listing(), (Arguments{"cornell.glb", "slender.glb"}));
    }
}

}  // namespace
