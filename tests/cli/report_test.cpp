// clv report: its files, how it goes on, and what it refuses.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "bindings/cli/progress.h"
#include "cli/run_command.h"
#include "support/temporary_folder.h"

namespace {

using namespace clv;

class ReportCommand : public TemporaryFolder {
protected:
    void expectRefused(const std::vector<std::string>& arguments, const std::vector<std::string>& words) const {
        const CommandResult result = runCommand(arguments);
        EXPECT_EQ(result.status, 2);
        EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
        for (const std::string& word : words) EXPECT_NE(result.err.find(word), std::string::npos) << result.err << "lacks " << word;
    }
};

TEST_F(ReportCommand, badPlacesAndScenesAreRefusedInOneLine) {
    expectRefused({"report"}, {"--out"});
    expectRefused({"report", "--out", file("a"), "--quick", "--full"}, {"--quick", "--full"});
    expectRefused({"report", "--out", write("text", "no folder")}, {"text", "expected a folder"});
    expectRefused({"report", "--out", "/proc/none"}, {"/proc/none"});
    expectRefused({"report", "--out", file("b"), "--scenes", "nowhere"}, {"nowhere"});
    std::filesystem::create_directory(file("c"));
    write("c/measurements.jsonl", "{\"key\":1}\n");
    expectRefused({"report", "--out", file("c")}, {"measurements.jsonl:1", "expected a measurement"});
}

TEST(TimeLeft, isWhatThePaceSoFarForetells) {
    EXPECT_EQ(timeLeftText(60.0, 0.25), ", 3:00 left");
    EXPECT_EQ(timeLeftText(125.0, 0.5), ", 2:05 left");
    EXPECT_EQ(timeLeftText(1.0, 0.5), "") << "too early to tell";
    EXPECT_EQ(timeLeftText(60.0, 0.0), "");
}

}  // namespace
