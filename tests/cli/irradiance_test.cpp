// clv irradiance and clv plan from outside: files, summaries, and what the result may depend on.
#include <array>
#include <cmath>
#include <sstream>

#include <nlohmann/json.hpp>

#include "cli/run_command.h"
#include "support/temporary_folder.h"

namespace {

using namespace clv;
using nlohmann::json;
using Arguments = std::vector<std::string>;

const char* const kHeader = "px,py,pz,nx,ny,nz";

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

// The last three columns of a row, W/m^2.
std::array<double, 3> irradianceOf(const std::string& row) {
    std::vector<double> numbers;
    std::istringstream stream(row);
    for (std::string cell; std::getline(stream, cell, ',');) numbers.push_back(std::stod(cell));
    EXPECT_EQ(numbers.size(), 9u) << row;
    return {numbers[6], numbers[7], numbers[8]};
}

class Irradiance : public TemporaryFolder {
protected:
    // In the Cornell box: floor, ceiling, back wall, left wall. Numbers as people write them.
    const Arguments rows_ = {"0.28,0.0,0.05,0,1,0", "1e-1,0.548,0.10,0,-1,0", "0.30,0.40,0.5592,0,0,-1", "0.45,0.300,.2,-1,0,0"};

    Arguments call(const std::string& scene, const Arguments& rows, const Arguments& more) const {
        std::string text = std::string(kHeader) + "\n";
        for (const std::string& row : rows) text += row + "\n";
        Arguments all = {"irradiance", "--scene", scene, "--points", write("p.csv", text), "--out", file("r.csv"), "--json"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    json run(const std::string& scene, const Arguments& rows, const Arguments& more) const {
        const CommandResult result = runCommand(call(scene, rows, more));
        EXPECT_EQ(result.status, 0) << result.err;
        // Of few rays light is noisy, and that is said.
        EXPECT_TRUE(result.err.empty() || result.err.starts_with("clv: the light at the points is noisy") || result.err.find("of the points got no light") != std::string::npos) << result.err;
        return json::parse(result.out);
    }
    // Rows of the result in the Cornell box, the header left out.
    Arguments resultOf(const Arguments& more, const Arguments& rows) const {
        run("cornell", rows, more);
        Arguments lines = linesOf(read(file("r.csv")));
        EXPECT_FALSE(lines.empty());
        lines.erase(lines.begin());
        return lines;
    }
    Arguments resultOf(const Arguments& more) const { return resultOf(more, rows_); }

    // Over all points and channels, W/m^2.
    double meanOf(const Arguments& more) const { return run("cornell", rows_, more).at("mean_irradiance"); }
};

TEST_F(Irradiance, keepsRowsAndColumnsAndAddsThreeFiniteValues) {
    const json report = run("cornell", rows_, {"--rays", "64k"});
    const Arguments lines = linesOf(read(file("r.csv")));
    ASSERT_EQ(lines.size(), rows_.size() + 1);
    EXPECT_EQ(lines[0], std::string(kHeader) + ",E_r,E_g,E_b");
    double sum = 0.0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        EXPECT_TRUE(lines[i + 1].starts_with(rows_[i] + ",")) << lines[i + 1];
        for (double value : irradianceOf(lines[i + 1])) {
            EXPECT_TRUE(std::isfinite(value) && value >= 0.0) << lines[i + 1];
            sum += value;
        }
    }
    EXPECT_NEAR(report.at("mean_irradiance"), sum / (3.0 * double(rows_.size())), 1e-5 * sum);
    EXPECT_EQ(listing(), (Arguments{"p.csv", "r.csv"}));
}

TEST_F(Irradiance, saysLevelsRaysAndTheTimeOfEachStage) {
    const json report = run("cornell", rows_, {"--rays", "64k", "--bounces", "all"});
    double weights = 0.0;
    for (const json& level : report.at("levels")) weights += level.at("weight").get<double>();
    EXPECT_NEAR(weights, 1.0, 1e-6);
    EXPECT_EQ(report.at("points"), rows_.size());
    EXPECT_GT(report.at("sweeps"), 2);
    EXPECT_GT(report.at("bytes"), 0);
    for (const char* stage : {"setup_ms", "rsm_ms", "guide_ms", "rays_ms", "trace_ms", "inject_ms", "merge_ms", "choose_ms", "evaluate_ms"})
        EXPECT_GE(report.at("stages").at(stage), 0.0) << stage;
    EXPECT_GT(report.at("frame_ms"), 0.0);
}

TEST_F(Irradiance, atAFixedResolutionAPointDoesNotDependOnTheOthers) {
    const Arguments options = {"--resolution", "32", "--rays", "64k"}, all = {"--resolution", "24", "--rays", "64k", "--bounces", "all"};
    for (const Arguments& more : {options, all}) {
        const Arguments together = resultOf(more);
        for (std::size_t i = 0; i < rows_.size(); ++i) EXPECT_EQ(resultOf(more, {rows_[i]}), Arguments{together[i]});
    }
}

TEST_F(Irradiance, isTheSameForASeedWhateverTheThreads) {
    for (const Arguments& more : {Arguments{"--rays", "128k"}, {"--rays", "1M", "--resolution", "32"}, {"--rays", "64k", "--bounces", "all"}}) {
        const auto with = [&](const Arguments& last) {
            Arguments all = more;
            all.insert(all.end(), last.begin(), last.end());
            return resultOf(all);
        };
        const Arguments one = with({"--threads", "1"});
        EXPECT_EQ(with({"--threads", "2"}), one);
        EXPECT_NE(with({"--seed", "2"}), one);
    }
}

TEST_F(Irradiance, tracesAsManyRaysAsAreAskedFor) {
    constexpr int kRounding = 8;  // rays by which parts of volumes are filled up
    for (const Arguments& more : {Arguments{}, {"--frames", "7"}, {"--bounces", "all", "--resolution", "16"}}) {
        for (int rays : {1, 50, 3001, 100003}) {
            Arguments all = {"--rays", std::to_string(rays)};
            all.insert(all.end(), more.begin(), more.end());
            const json report = run("cornell", rows_, all);
            // Each sweep rounds up for itself.
            const int sweeps = report.at("sweeps");
            EXPECT_LE(report.at("rays"), rays + kRounding * sweeps) << report;
            EXPECT_GE(report.at("rays"), sweeps == 1 ? rays : rays / 2) << report;
        }
    }
}

TEST_F(Irradiance, framesAndStoragesAgreeOnTheLight) {
    const Arguments base = {"--resolution", "16", "--rays", "512k"};
    const double expected = meanOf(base);
    const auto with = [&](const Arguments& last) {
        Arguments all = base;
        all.insert(all.end(), last.begin(), last.end());
        return meanOf(all);
    };
    EXPECT_NEAR(with({"--frames", "4"}), expected, 0.01 * expected);
    for (const char* storage : {"cube9", "cube", "sh2", "sh1"}) EXPECT_NEAR(with({"--storage", storage}), expected, 0.25 * expected) << storage;
    // What the storages tell apart is light on oblique normals.
    const Arguments oblique = {"0.28,0.0,0.05,0.6,0.8,0"};
    EXPECT_NE(resultOf({"--rays", "64k", "--storage", "cube"}, oblique), resultOf({"--rays", "64k"}, oblique));
}

TEST_F(Irradiance, aShiftOfTheGridChangesLittle) {
    const Arguments base = {"--resolution", "32", "--rays", "512k"};
    Arguments shifted = base;
    shifted.insert(shifted.end(), {"--cell-shift", "0.5,-0.25,0.75"});
    const double expected = meanOf(base), moved = meanOf(shifted);
    EXPECT_NE(moved, expected);
    EXPECT_NEAR(moved, expected, 0.1 * expected);
    // A whole cell is no shift at all.
    shifted.back() = "1,1,0";
    EXPECT_EQ(meanOf(shifted), expected);
}

TEST_F(Irradiance, furtherBouncesAddLight) {
    const Arguments one = resultOf({"--rays", "256k", "--resolution", "32"}), all = resultOf({"--rays", "512k", "--resolution", "32", "--bounces", "all"});
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        for (int c = 0; c < 3; ++c) EXPECT_GT(irradianceOf(all[i])[c], irradianceOf(one[i])[c]) << rows_[i];
    }
}

TEST_F(Irradiance, raysMayMeetAProxyInsteadOfTheScene) {
    const Arguments base = {"--resolution", "16", "--rays", "64k"};
    ASSERT_EQ(runCommand({"scenes", "--write", file("cornell.glb")}).status, 0);
    const double expected = meanOf(base);
    const auto with = [&](const std::string& proxy) { return meanOf({"--resolution", "16", "--rays", "64k", "--proxy", proxy}); };
    // The same scene as a file, its positions rounded.
    EXPECT_NEAR(with(file("cornell.glb")), expected, 0.005 * expected);
    // A proxy elsewhere stops no ray: light passes the blocks of the box.
    EXPECT_GT(std::abs(with("corridor") - expected), 0.01 * expected);
}

TEST_F(Irradiance, lightsOfAFileReplaceThoseOfTheScene) {
    const auto lamp = [&](const char* intensity) {
        return write("l.json", std::string(R"({"lights":[{"type":"point","position":[0.28,0.4,0.28],"intensity":)") + intensity + "}]}");
    };
    const Arguments base = {"--resolution", "16", "--rays", "64k", "--lights"};
    const auto with = [&](const char* intensity) {
        Arguments all = base;
        all.push_back(lamp(intensity));
        return meanOf(all);
    };
    const double white = with("[1,1,1]");
    EXPECT_GT(white, 0.0);
    EXPECT_NEAR(with("[2,2,2]"), 2.0 * white, 1e-4 * white);
    with("[0,1,0]");
    for (const std::string& row : linesOf(read(file("r.csv")))) {
        if (row.starts_with("px")) continue;
        EXPECT_EQ(irradianceOf(row)[0], 0.0) << row;
    }
}

TEST_F(Irradiance, noLightMeansZerosAndNoStageRuns) {
    const std::string off = write("l.json", R"({"lights":[{"type":"point","position":[0.28,0.4,0.28],"intensity":[0,0,0]}]})");
    const json report = run("cornell", rows_, {"--lights", off, "--bounces", "all"});
    for (const std::string& row : linesOf(read(file("r.csv")))) {
        if (row.starts_with("px")) continue;
        EXPECT_EQ(irradianceOf(row), (std::array{0.0, 0.0, 0.0})) << row;
    }
    EXPECT_TRUE(report.at("stages").empty());
    EXPECT_EQ(report.at("bytes"), 0);
    EXPECT_EQ(report.at("rays"), 0);
}

TEST_F(Irradiance, usesTheTimeItIsGiven) {
    const json brief = run("cornell", rows_, {"--resolution", "16", "--seconds", "0.2"}), longer = run("cornell", rows_, {"--resolution", "16", "--seconds", "1"});
    EXPECT_GT(longer.at("rays"), 2 * brief.at("rays").get<double>());
}

// What a plan says is left out, by name.
class Plan : public Irradiance {
protected:
    json plan(const std::string& scene, const Arguments& more = {}) const {
        Arguments all = {"plan", "--scene", scene, "--json"};
        all.insert(all.end(), more.begin(), more.end());
        const CommandResult result = runCommand(all);
        EXPECT_EQ(result.status, 0) << result.err;
        return json::parse(result.out);
    }
    static bool leavesOut(const json& plan, const std::string& name) {
        bool needed = false, leftOut = false;
        for (const json& decision : plan.at("needed")) needed = needed || decision.at("name") == name;
        for (const json& decision : plan.at("left_out")) {
            leftOut = leftOut || decision.at("name") == name;
            EXPECT_NE(decision.at("reason"), "");
        }
        EXPECT_NE(needed, leftOut) << name;
        return leftOut;
    }
};

TEST_F(Plan, colourIsLeftOutOfAGreySceneAndOfItsMemory) {
    EXPECT_TRUE(leavesOut(plan("furnace_box"), "colour"));
    EXPECT_FALSE(leavesOut(plan("cornell"), "colour"));
    const Arguments rows = {"0.1,0.49,0.1,0,-1,0"}, options = {"--resolution", "16", "--rays", "4k"};
    const json grey = run("furnace_box", rows, options);
    EXPECT_EQ(grey.at("channels"), 1);
    // The same scene under a coloured lamp: as many slots, each with a longer record.
    Arguments coloured = options;
    coloured.insert(coloured.end(), {"--lights", write("l.json", R"({"lights":[{"type":"point","position":[0.07,0.21,0.05],"intensity":[1,1,0.5]}]})")});
    const json colour = run("furnace_box", rows, coloured);
    EXPECT_EQ(colour.at("channels"), 3);
    EXPECT_EQ(colour.at("slots"), grey.at("slots"));
    EXPECT_GT(colour.at("bytes"), grey.at("bytes"));
    // The channel that is left does what each of the three did.
    const std::array<double, 3> inColour = irradianceOf(linesOf(read(file("r.csv")))[1]);
    run("furnace_box", rows, options);
    const std::array<double, 3> inGrey = irradianceOf(linesOf(read(file("r.csv")))[1]);
    EXPECT_NEAR(inGrey[0], inColour[0], 1e-4 * inColour[0]);
    EXPECT_EQ(inGrey[0], inGrey[2]);
}

TEST_F(Plan, oneHalfIsLeftOutWhereTheResolutionIsGiven) {
    EXPECT_FALSE(leavesOut(plan("cornell"), "two halves"));
    EXPECT_TRUE(leavesOut(plan("cornell", {"--resolution", "16"}), "two halves"));
    const json chosen = run("cornell", rows_, {"--rays", "4k"}), given = run("cornell", rows_, {"--rays", "4k", "--resolution", "16"});
    EXPECT_FALSE(given.at("stages").contains("choose_ms"));
    EXPECT_TRUE(chosen.at("stages").contains("choose_ms"));
    EXPECT_EQ(given.at("levels").size(), 1u);
}

TEST_F(Plan, feedbackIsLeftOutOfOneBounce) {
    EXPECT_TRUE(leavesOut(plan("cornell"), "feedback"));
    EXPECT_FALSE(leavesOut(plan("cornell", {"--bounces", "all"}), "feedback"));
    const Arguments options = {"--rays", "4k", "--resolution", "32"};
    Arguments all = options;
    all.insert(all.end(), {"--bounces", "all"});
    const json one = run("cornell", rows_, options), every = run("cornell", rows_, all);
    EXPECT_EQ(one.at("sweeps"), 1);
    EXPECT_GT(every.at("sweeps"), 4);
    // A level of their own for further bounces, and no more cells than those of the first.
    EXPECT_EQ(one.at("slots"), every.at("slots"));
    EXPECT_GT(every.at("bytes"), one.at("bytes"));
}

TEST_F(Plan, everythingIsLeftOutWithoutLight) {
    const std::string off = write("l.json", R"({"lights":[{"type":"point","position":[0.28,0.4,0.28],"intensity":[0,0,0]}]})");
    const json report = plan("cornell", {"--lights", off});
    EXPECT_TRUE(leavesOut(report, "stages"));
    EXPECT_TRUE(report.at("needed").empty());
    EXPECT_FALSE(report.contains("resolutions"));
}

TEST_F(Plan, raysAreGuidedOnlyWhereManyLeave) {
    EXPECT_FALSE(run("furnace_box", {"0.1,0.49,0.1,0,-1,0"}, {"--rays", "16k", "--resolution", "16"}).at("guided"));
    const json open = run("atrium", {"1,0,1,0,1,0"}, {"--rays", "16k", "--resolution", "16"});
    EXPECT_TRUE(open.at("guided"));
    EXPECT_LT(open.at("share_of_rays_that_meet"), 0.5);
}

TEST_F(Plan, memoryStaysBelowWhatIsAnnounced) {
    for (const Arguments& more : {Arguments{"--resolution", "16"}, {"--resolution", "16", "--bounces", "all"}, {"--resolution", "32", "--storage", "sh1"}}) {
        Arguments options = more;
        options.insert(options.end(), {"--rays", "64k"});
        const json announced = plan("cornell", options).at("resolutions");
        ASSERT_EQ(announced.size(), 1u);
        const json taken = run("cornell", rows_, options);
        EXPECT_LE(taken.at("bytes"), announced[0].at("bytes_at_most"));
        EXPECT_LE(announced[0].at("bytes_if_no_wall_cuts_a_cell"), announced[0].at("bytes_at_most"));
    }
    EXPECT_EQ(plan("cornell").at("resolutions").size(), 4u);
    EXPECT_EQ(plan("cornell", {"--rays", "4k"}).at("resolutions").size(), 5u) << "8^3 is tried too";
}

}  // namespace
