// clv reference from outside: its files, its summary, its budgets, its interruption.
#include <chrono>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/run_command.h"
#include "support/temporary_folder.h"

namespace reference_test {

using namespace clv;
using nlohmann::json;
using Arguments = std::vector<std::string>;

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

class Reference : public TemporaryFolder {
protected:
    // On the floor and the ceiling of the box.
    const std::string rows_[2] = {"0.28,0.0,0.05,0,1,0", "0.10,0.548,0.10,0,-1,0"};

    Arguments call(const Arguments& more) const {
        const std::string points = write("p.csv", "px,py,pz,nx,ny,nz\n" + rows_[0] + "\r\n" + rows_[1] + "\n");
        Arguments all = {"reference", "--scene", "cornell", "--points", points, "--out", file("r.csv")};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    json summary(const Arguments& more) const {
        Arguments all = call(more);
        all.push_back("--json");
        const CommandResult result = runCommand(all);
        EXPECT_EQ(result.status, 0) << result.err;
        EXPECT_EQ(result.err, "");
        return json::parse(result.out);
    }
};

TEST_F(Reference, writesTheRowsInOrderWithIrradianceAndStandardError) {
    const json report = summary({"--samples", "256"});
    const auto lines = linesOf(read(file("r.csv")));
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_EQ(lines[0], "px,py,pz,nx,ny,nz,E_r,E_g,E_b,s_r,s_g,s_b");
    for (int row = 0; row < 2; ++row) {
        EXPECT_TRUE(lines[std::size_t(row) + 1].starts_with(rows_[row] + ","));
        EXPECT_EQ(std::ranges::count(lines[std::size_t(row) + 1], ','), 11);
    }
    EXPECT_EQ(report.at("points"), 2);
    EXPECT_EQ(report.at("samples_per_point"), 256);
    EXPECT_GT(report.at("mean_irradiance"), 0.0);
    EXPECT_GT(report.at("mean_standard_error"), 0.0);
    EXPECT_GE(report.at("seconds"), 0.0);
    EXPECT_EQ(listing(), (Arguments{"p.csv", "r.csv"}));
}

TEST_F(Reference, isTheSameForASeedWhateverTheThreads) {
    summary({"--samples", "64", "--threads", "1"});
    const std::string one = read(file("r.csv"));
    summary({"--samples", "64", "--threads", "2"});
    EXPECT_EQ(read(file("r.csv")), one);
    summary({"--samples", "64", "--seed", "2"});
    EXPECT_NE(read(file("r.csv")), one);
}

TEST_F(Reference, reachesTheErrorThatIsAskedFor) {
    const json loose = summary({"--target-error", "0.02"}), tight = summary({"--target-error", "0.005"});
    EXPECT_LE(loose.at("relative_standard_error"), 0.02);
    EXPECT_LE(tight.at("relative_standard_error"), 0.005);
    EXPECT_GT(tight.at("samples_per_point"), loose.at("samples_per_point"));
}

TEST_F(Reference, usesTheTimeItIsGiven) {
    const json report = summary({"--seconds", "0.5"});
    EXPECT_GT(report.at("seconds"), 0.25);
    EXPECT_LT(report.at("seconds"), 2.0);
    EXPECT_GT(report.at("samples_per_point"), 16);
}

TEST_F(Reference, saysWhereALampIsTooNearToASurfaceForItsPaths) {
    const auto warningsOf = [&](double height) {
        const std::string lights = write("l.json", fmt::format(R"({{"lights": [{{"name": "spark", "type": "point", "position": [0.3, {}, 0.1], "intensity": [1, 1, 1]}}]}})", height));
        const CommandResult result = runCommand(call({"--samples", "64", "--lights", lights, "--json"}));
        EXPECT_EQ(result.status, 0) << result.err;
        return json::parse(result.out).value("warnings", std::vector<std::string>());
    };
    ASSERT_EQ(warningsOf(1e-4).size(), 1u);
    EXPECT_TRUE(warningsOf(1e-4)[0].starts_with("light \"spark\" sends a quarter of its light to surfaces within 0.000"));
    EXPECT_TRUE(warningsOf(0.3).empty());
}

TEST_F(Reference, printsLinesForPeopleWithoutJson) {
    const CommandResult result = runCommand(call({"--samples", "16"}));
    EXPECT_EQ(result.status, 0);
    EXPECT_NE(result.out.find("\nrelative_standard_error  "), std::string::npos) << result.out;
}

TEST_F(Reference, anInterruptLeavesTheOldFileAndNothingElse) {
    for (int signal : {SIGINT, SIGTERM}) {
        Arguments arguments = call({"--seconds", "60"});
        write("r.csv", "old");
        RunningCommand command(arguments);
        // Wait for the temporary folder: from then on the command is at work.
        const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
        while (listing().size() < 3 && std::chrono::steady_clock::now() < deadline) std::this_thread::sleep_for(std::chrono::milliseconds(5));
        ASSERT_EQ(listing().size(), 3u);
        command.send(signal);
        EXPECT_EQ(command.wait().status, 128 + signal);
        EXPECT_EQ(listing(), (Arguments{"p.csv", "r.csv"}));
        EXPECT_EQ(read(file("r.csv")), "old");
    }
}

TEST_F(Reference, showsABarOnATerminalOnceASecondHasPassed) {
    const CommandResult longRun = RunningCommand(call({"--seconds", "1.5"}), true).wait();
    EXPECT_NE(longRun.err.find("path tracing ["), std::string::npos);
    EXPECT_TRUE(longRun.err.ends_with("\r\x1b[K"));
    const CommandResult shortRun = RunningCommand(call({"--samples", "16"}), true).wait();
    EXPECT_EQ(shortRun.err, "");
}

}  // namespace reference_test
