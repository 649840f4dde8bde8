// Exit statuses and the one line that goes with a failure.
#include <algorithm>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "cli/run_command.h"
#include "support/temporary_folder.h"
#include "clv/clv.h"

namespace {

using namespace clv;
using Arguments = std::vector<std::string>;

class Usage : public TemporaryFolder {
protected:
    void SetUp() override {
        TemporaryFolder::SetUp();
        points_ = write("p.csv", "px,py,pz,nx,ny,nz\n0,0,0,0,1,0\n");
    }
    // A complete call of `command` with more arguments behind.
    Arguments call(const std::string& command, const Arguments& more = {}) const {
        Arguments all = {command, "--scene", "cornell", "--points", points_, "--out", file("r.csv")};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    // Expects exit status 2, nothing on stdout, and one line on stderr that holds each of `words`; and no output file.
    void expectRefused(const Arguments& arguments, const Arguments& words) const {
        const auto before = listing();
        const CommandResult result = runCommand(arguments);
        EXPECT_EQ(result.status, 2);
        EXPECT_EQ(result.out, "");
        EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
        for (const std::string& word : words) EXPECT_NE(result.err.find(word), std::string::npos) << result.err << "lacks " << word;
        EXPECT_EQ(listing(), before);
    }

    std::string points_;
};

TEST_F(Usage, helpAndVersionAreAnsweredOnStdout) {
    for (const Arguments& arguments : {Arguments{"--help"}, {"irradiance", "--help"}, {"reference", "--help"}, {"render", "--help"}, {"plan", "--help"}, {"report", "--help"}, {"scenes", "--help"}, {"info", "--help"}}) {
        const CommandResult result = runCommand(arguments);
        EXPECT_EQ(result.status, 0);
        EXPECT_EQ(result.err, "");
        EXPECT_NE(result.out.find("--help"), std::string::npos);
    }
    const std::string version = std::to_string(CLV_VERSION_MAJOR) + "." + std::to_string(CLV_VERSION_MINOR) + "." + std::to_string(CLV_VERSION_PATCH);
    EXPECT_EQ(runCommand({"--version"}).out, version + "\n");
}

TEST_F(Usage, filesThatAreReadAreNotReplaced) {
    const std::string lights = write("l.json", R"({"lights": [{"type": "point", "position": [0, 1, 0], "intensity": [1, 1, 1]}]})");
    std::filesystem::create_symlink(points_, file("link.csv"));
    for (const char* command : {"irradiance", "reference"}) {
        for (const std::string& out : {points_, lights, file("link.csv")}) {
            const std::string before = read(out);
            expectRefused({command, "--scene", "cornell", "--lights", lights, "--points", points_, "--out", out}, {"--out", out, "which is read"});
            EXPECT_EQ(read(out), before);
        }
    }
}

TEST_F(Usage, badUsageIsRefusedInOneLine) {
    expectRefused({}, {"clv --help"});
    expectRefused({"paint"}, {"paint"});
    expectRefused({"irradiance", "--scene", "cornell"}, {"clv irradiance", "--points"});
    expectRefused(call("irradiance", {"--wrong"}), {"--wrong"});
    expectRefused(call("irradiance", {"--seconds", "0.3", "--frames", "2"}), {"--seconds", "--frames"});
    expectRefused(call("reference", {"--threads", "-1"}), {"--threads"});
    expectRefused(call("reference", {"--seed", "-1"}), {"--seed", "4294967295"});
    expectRefused({"report", "--out", file("out"), "--truth-samples", "-1"}, {"--truth-samples", "expected a count such as 65536, 64k or 4M"});
    expectRefused(call("reference", {"--backend", "metal"}), {"--backend"});
    expectRefused(call("reference", {"--bounces", "two"}), {"--bounces"});
    expectRefused(call("reference", {"--samples", "16", "--seconds", "1"}), {"--samples", "--seconds"});
    expectRefused(call("reference", {"--seconds", "nan"}), {"--seconds", "nan"});
    expectRefused(call("reference", {"--target-error", "0"}), {"--target-error"});
}

TEST_F(Usage, resolutionsRaysAndShiftsOutOfRangeAreRefused) {
    for (const char* resolution : {"0", "1000000", "1025", "-4", "big"}) expectRefused(call("irradiance", {"--resolution", resolution}), {"--resolution"});
    for (const char* rays : {"0", "-1", "64q", "k", "64kk", "99999999999999999999"}) expectRefused(call("irradiance", {"--rays", rays}), {"--rays"});
    for (const char* shift : {"0.5", "0,0", "0,0,2", "0,0,nan", "a,b,c"}) expectRefused(call("irradiance", {"--cell-shift", shift}), {"--cell-shift"});
    expectRefused(call("irradiance", {"--storage", "cube10"}), {"--storage", "cube9"});
    expectRefused(call("irradiance", {"--frames", "0"}), {"--frames"});
    expectRefused(call("irradiance", {"--rays", "64k", "--seconds", "1"}), {"--rays", "--seconds"});
    expectRefused(call("irradiance", {"--motion", "m.json"}), {"--motion", "not available yet"});
}

TEST_F(Usage, commandsWithoutWorkForAGpuRefuseVulkanAndTakeTheCpuForAuto) {
    expectRefused({"info", "--backend", "vulkan"}, {"info computes on the CPU alone"});
    expectRefused(call("reference", {"--backend", "vulkan"}), {"reference computes on the CPU alone"});
    const CommandResult result = runCommand({"info", "--backend", "auto", "--json"});
    EXPECT_EQ(nlohmann::json::parse(result.out).at("backend"), "cpu");
}

TEST_F(Usage, badInputIsRefusedInOneLineThatNamesIt) {
    expectRefused({"reference", "--scene", "nowhere.glb", "--points", points_, "--out", file("r.csv")}, {"nowhere.glb"});
    expectRefused({"reference", "--scene", "cornell", "--points", file("none.csv"), "--out", file("r.csv")}, {"none.csv"});
    const std::string bad = write("bad.csv", "px,py,pz,nx,ny,nz\n0,0,0,0,3,0\n");
    expectRefused({"reference", "--scene", "cornell", "--points", bad, "--out", file("r.csv")}, {"bad.csv:2", "unit length"});
    expectRefused({"irradiance", "--scene", "cornell", "--points", bad, "--out", file("r.csv")}, {"bad.csv:2", "unit length"});
    expectRefused(call("reference", {"--lights", write("l.json", "{\"lights\":[]}")}), {"l.json", "lights"});
}

TEST_F(Usage, aPlaceThatCannotBeWrittenIsRefused) {
    expectRefused({"reference", "--scene", "cornell", "--points", points_, "--out", file("missing/r.csv")}, {"missing", "can be written"});
    expectRefused({"scenes", "--write", points_ + "/cornell.glb"}, {"p.csv", "can be written"});
    expectRefused({"render", "--scene", "cornell", "--out", points_}, {"p.csv"});
    const std::string tooLong(300, 'n');
    expectRefused({"reference", "--scene", "cornell", "--points", points_, "--out", file(tooLong)}, {tooLong, "expected the name of a file"});
    expectRefused({"reference", "--scene", "cornell", "--points", points_, "--out", file(tooLong + "/r.csv")}, {tooLong, "expected"});
    expectRefused({"render", "--scene", "cornell", "--out", file(tooLong)}, {tooLong, "expected the name of a file"});
    expectRefused({"bake", "--scene", "cornell", "--out", file(tooLong + ".vtm")}, {tooLong, "expected the name of a file"});
}

TEST_F(Usage, anOutputThatCannotBePrintedIsAFailureAtRunTime) {
    const int status = std::system(CLV_BINARY_DIR "/clv info > /dev/full 2> /dev/null");
    EXPECT_EQ(WEXITSTATUS(status), 1);
}

TEST_F(Usage, anErrorOrAWarningThatCannotBePrintedKeepsTheExitStatus) {
    const auto statusOf = [](const std::string& call) { return WEXITSTATUS(std::system((CLV_BINARY_DIR "/clv " + call).c_str())); };
    const std::string warned = "irradiance --scene cornell --rays 4k --backend auto --device none --points " + points_ + " --out " + file("r.csv") + " > /dev/null ";
    for (const char* nowhere : {"2> /dev/full", "2>&-", "2>&- <&-"}) {
        EXPECT_EQ(statusOf(std::string("nope ") + nowhere), 2) << nowhere;
        EXPECT_EQ(statusOf(warned + nowhere), 0) << nowhere;
        EXPECT_TRUE(std::filesystem::remove(file("r.csv"))) << nowhere;
    }
    EXPECT_EQ(statusOf("scenes --write " + file("cornell.glb") + " > /dev/null <&-"), 0);
    EXPECT_EQ(statusOf("plan --scene " + file("cornell.glb") + " <&- >&- 2> /dev/null"), 1) << "a plan that cannot be printed";
    // Into a pipe that nobody reads any more.
    std::system(("{ sleep 0.2; " CLV_BINARY_DIR "/clv nope; echo $? > " + file("status") + "; } 2>&1 | true").c_str());
    for (int k = 0; k < 100 && !std::filesystem::exists(file("status")); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_EQ(read(file("status")), "2\n");
}

TEST_F(Usage, controlCharactersInInputAreShownNotSent) {
    expectRefused({"reference", "--scene", "cornell", "--points", write("esc.csv", "px,py,pz,nx,ny,nz\n\x1b[2J,0,0,0,1,0\n"), "--out", file("r.csv")}, {"esc.csv:2", "\\x1b[2J"});
    expectRefused(call("reference", {"--lights", write("l.json", R"({"lights": [], "a\rb\u007f": 1})")}), {"l.json", "a\\x0db\\x7f"});
}

}  // namespace
