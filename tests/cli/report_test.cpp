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
    expectRefused({"report", "--out", file("b"), "--methods", "magic"}, {"magic", "path_tracing"});
    expectRefused({"report", "--out", file("b"), "--methods", "path_tracing", "--most-rays", "1"}, {"--most-rays 1", "nothing to measure"});
    std::filesystem::create_directory(file("c"));
    write("c/measurements.jsonl", "{\"key\":1}\n");
    expectRefused({"report", "--out", file("c")}, {"measurements.jsonl:1", "expected a measurement"});
}

TEST_F(ReportCommand, writesAPageTablesAndMeasurementsOnce) {
    const std::vector<std::string> arguments = {"report", "--out", file("r"), "--scenes", "white_sphere", "--methods", "path_tracing", "--points", "20",
                                                "--truth-samples", "64", "--repeats", "2", "--most-rays", "65536", "--json"};
    const CommandResult result = runCommand(arguments);
    ASSERT_EQ(result.status, 0) << result.err;
    const auto said = nlohmann::json::parse(result.out);
    EXPECT_EQ(said.at("files"), nlohmann::json({"report.html", "report.csv", "report.json"}));
    const auto report = nlohmann::json::parse(read(file("r/report.json")));
    for (const char* key : {"commit", "processor", "date", "command_line"}) EXPECT_TRUE(report.contains(key)) << key;
    EXPECT_FALSE(report.at("vulkan").get<std::string>().empty()) << "the device, or why none was measured";
    ASSERT_EQ(report.at("measurements").size(), 2u) << "16k and 64k rays";
    EXPECT_EQ(said.at("measurements"), report.at("measurements").size());
    for (const auto& m : report.at("measurements")) EXPECT_EQ(m.at("method"), "path_tracing");
    EXPECT_LT(report.at("measurements").back().at("relative_rmse"), report.at("measurements").front().at("relative_rmse"));
    const std::string csv = read(file("r/report.csv"));
    EXPECT_EQ(std::size_t(std::ranges::count(csv, '\n')), 1 + report.at("measurements").size());
    const std::string page = read(file("r/report.html"));
    for (const char* words : {"What a millisecond buys", "<td>trace</td><td>ray</td><td>bare Embree</td>"}) EXPECT_NE(page.find(words), std::string::npos) << words;
    ASSERT_EQ(report.at("stages").size(), 1u);
    EXPECT_GT(report.at("stages")[0].at("times").size(), 7u);

    const std::string measured = read(file("r/measurements.jsonl")), stages = read(file("r/stages.json"));
    ASSERT_EQ(runCommand(arguments).status, 0);
    EXPECT_EQ(read(file("r/measurements.jsonl")), measured) << "nothing is measured twice";
    EXPECT_EQ(read(file("r/stages.json")), stages);
    for (const std::string& name : listing("r")) EXPECT_FALSE(name.starts_with(".")) << name;
}

TEST_F(ReportCommand, whereNoVulkanDeviceIsItSaysSoAndMeasuresTheRest) {
    setenv("VK_DRIVER_FILES", "/nowhere", 1);
    setenv("VK_ICD_FILENAMES", "/nowhere", 1);
    const CommandResult result = runCommand({"report", "--out", file("r"), "--scenes", "white_sphere", "--methods", "path_tracing", "--points", "20", "--truth-samples", "64",
                                             "--repeats", "1", "--most-rays", "16k", "--json"});
    unsetenv("VK_DRIVER_FILES");
    unsetenv("VK_ICD_FILENAMES");
    ASSERT_EQ(result.status, 0) << result.err;
    const auto said = nlohmann::json::parse(result.out);
    EXPECT_TRUE(said.at("vulkan").get<std::string>().starts_with("not measured: ")) << said.at("vulkan");
    EXPECT_EQ(said.at("measurements"), 1);
}

TEST_F(ReportCommand, aWorseReportFailsAndSaysWhatIsWorse) {
    std::vector<std::string> arguments = {"report", "--out", file("r"), "--scenes", "white_sphere", "--methods", "path_tracing", "--points", "20",
                                          "--truth-samples", "64", "--repeats", "6", "--most-rays", "65536", "--compare", file("r/report.json")};
    expectRefused(arguments, {"report.json", "expected the report.json"});
    arguments.resize(arguments.size() - 2);
    ASSERT_EQ(runCommand(arguments).status, 0);
    auto report = nlohmann::json::parse(read(file("r/report.json")));
    auto compared = arguments;
    compared.insert(compared.end(), {"--compare", write("old.json", report.dump())});
    EXPECT_EQ(runCommand(compared).status, 0);

    report["measurements"][0]["relative_rmse"] = 0.0, report["measurements"][0]["relative_rmse_interval"] = 0.0;
    write("old.json", report.dump());
    const CommandResult worse = runCommand(compared);
    EXPECT_EQ(worse.status, 1) << worse.err;
    EXPECT_EQ(std::ranges::count(worse.err, '\n'), 1) << worse.err;
    EXPECT_NE(worse.err.find("white_sphere, path_tracing, 16k rays: relative RMSE"), std::string::npos) << worse.err;
}

TEST(TimeLeft, isWhatThePaceSoFarForetells) {
    EXPECT_EQ(timeLeftText(60.0, 0.25), ", 3:00 left");
    EXPECT_EQ(timeLeftText(125.0, 0.5), ", 2:05 left");
    EXPECT_EQ(timeLeftText(1.0, 0.5), "") << "too early to tell";
    EXPECT_EQ(timeLeftText(60.0, 0.0), "");
}

}  // namespace
