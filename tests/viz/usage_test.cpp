// What clv-viz says to bad usage, and what it prints of a typed position.
#include <sys/wait.h>

#include "support/hall_volume.h"
#include "viz/virtual_display.h"
#include "viz/viz_command.h"

using namespace clv;
using namespace clv::test;

namespace {

class VizUsage : public VizCommand {};

TEST_F(VizUsage, badOptionsGiveOneLineThatSaysWhatWasExpected) {
    const std::string volume = bake("cornell", 4);
    const std::vector<std::vector<std::string>> bad = {{"--slice", "w=1"},      {"--size", "10"},         {"--view", "nothing"}, {"--pick", "1,2"},
                                                       {"--pick", "0,0,0,1,1,0"}, {"--range", "2,1"},       {"--camera", "roof"},  {"--camera", "0,0,0,0,0,0"},
                                                       {"--cascade", "9"},        {"--scene", "nowhere.glb"}, {"--exposure", "nan"}, {"--on", "surfaces"}, {"--frame", "1"},
                                                       {"--without"}, {"--without", "--view", "mesh"}, {"--difference", volume, "--view", "mesh"}, {"--on", "volume"}, {"--slice", "z=0.1"},
                                                       {"--view", "samples", "--on", "slices"}, {"--view", "samples", "--on", "volume", "--slice", "z=0.1"},
                                                       {"--view", "samples", "--slice", "x=99"}, {"--play"}, {"--benchmark"}, {"--histogram", "--probe", "0,0,0,1,1,1"}};
    for (std::vector<std::string> arguments : bad) {
        arguments.insert(arguments.begin(), {volume, "--out", file("p.png")});
        const CommandResult result = runViz(arguments);
        EXPECT_EQ(result.status, 2) << arguments[3] << " " << arguments.back();
        EXPECT_TRUE(result.err.starts_with("clv-viz: ")) << result.err;
        EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << arguments[3] << " " << result.err;
        EXPECT_FALSE(std::filesystem::exists(file("p.png"))) << arguments[3];
    }
}

TEST_F(VizUsage, aPictureIsNamedAsOne) {
    const CommandResult result = runViz({bake("cornell", 4), "--out", file("p.jpg")});
    EXPECT_EQ(result.status, 2);
    EXPECT_TRUE(contains(result.err, "p.jpg: expected a name that ends in .png")) << result.err;
    EXPECT_EQ(listing(), (std::vector<std::string>{"V", "V.vtm"}));
}

TEST_F(VizUsage, seriesArePlayedAndPlanesCutTheVolumeOrAWordIsSaid) {
    const VirtualDisplay display;
    const std::string volume = bake("cornell", 4);
    EXPECT_TRUE(contains(runViz({volume, "--play"}).err, "--play: expected a series"));
    EXPECT_TRUE(contains(runViz({volume, "--view", "open", "--slice", "y=-3"}).err, "--slice y=-3: expected a place in the volume, from "));
}

TEST_F(VizUsage, liveLightNeedsTheScene) {
    const VirtualDisplay display;
    writeVolume("V.vtm", hallVolume(), pathOf());
    const CommandResult result = runViz({file("V.vtm"), "--live"});
    EXPECT_EQ(result.status, 2);
    EXPECT_TRUE(contains(result.err, "--live: expected the scene of the volume")) << result.err;
}

TEST_F(VizUsage, aClosedStderrChangesNoExitStatus) {
    const std::string command = std::string(kProgram) + " " + file("none.vtm") + " --out " + file("p.png") + " 2>&-";
    EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 2);
}

TEST_F(VizUsage, aMissingFileIsNamed) {
    const CommandResult result = runViz({file("none.vtm"), "--out", file("p.png")});
    EXPECT_EQ(result.status, 2);
    EXPECT_TRUE(contains(result.err, "none.vtm")) << result.err;
}

TEST_F(VizUsage, withoutADisplayAndXvfbItSaysWhatIsMissing) {
    const std::string volume = bake("cornell", 4);
    unsetenv("DISPLAY");
    EXPECT_EQ(runViz({volume}).status, 2);
    const std::string path = getenv("PATH");
    setenv("PATH", folder_.c_str(), 1);
    const CommandResult result = runViz({volume, "--out", file("p.png")});
    setenv("PATH", path.c_str(), 1);
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(contains(result.err, "Xvfb")) << result.err;
}

TEST_F(VizUsage, aTypedPositionPrintsWhatTheVolumeSaysThere) {
    const std::string file = bake("cornell", 12);
    const BakedVolume volume = readVolume(file);
    const ClvVolume& grid = volume.cascades[0].level.volume;
    const vec3 position = clvCellCenter(grid, ivec3(6, 6, 6)) + 0.1f * grid.cellSize;
    const glm::dvec3 world = glm::dvec3(position) + volume.anchor;
    const std::string typed = std::to_string(world.x) + "," + std::to_string(world.y) + "," + std::to_string(world.z);
    const CommandResult result = runViz({file, "--pick", typed + ",0,1,0"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(contains(result.out, "cell 6 6 6 of cascade 0")) << result.out;
    const std::size_t at = result.out.find("the surface receives (");
    ASSERT_NE(at, std::string::npos) << result.out;
    vec3 printed(0.0f);
    ASSERT_EQ(std::sscanf(result.out.c_str() + at, "the surface receives (%f, %f, %f)", &printed.x, &printed.y, &printed.z), 3);
    const vec3 expected = irradianceAt(volume, {position, 0.0f, vec3(0.0f, 1.0f, 0.0f), 0.0f});
    // Four digits are printed.
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(printed[c], expected[c], 1e-3f * expected[c]);
    EXPECT_GT(expected.x, 0.0f);
}

// What of the light on the sides of a cell is printed: the sum of the channels on +y, and the largest dynamicity.
struct PrintedCell {
    double up = 0.0, dynamicity = 0.0;

    explicit PrintedCell(const std::string& text) {
        for (const char* side : kSideNames) {
            const std::size_t at = text.find(std::string("\n") + side + " ");
            double r = 0.0, g = 0.0, b = 0.0, error = 0.0, d = 0.0;
            char between[32];
            if (at == std::string::npos || std::sscanf(text.c_str() + at, "%31s %lf %lf %lf %lf %lf", between, &r, &g, &b, &error, &d) < 4) continue;
            // An error that is not known is a word.
            if (std::sscanf(text.c_str() + at, "%*s %*s %*s %*s %*s %lf", &d) == 1) dynamicity = std::max(dynamicity, d);
            if (side == std::string("+y")) up = r + g + b;
        }
    }
};

TEST_F(VizUsage, liveLightDoesByOptionsWhatSlidersAndTheMouseDo) {
    const auto live = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"--live", "--scene", "cornell", "--pick", "0.28,0.1,0.1"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const CommandResult result = runViz(arguments);
        EXPECT_EQ(result.status, 0) << result.err;
        return result.out;
    };
    const std::string plain = live({});
    EXPECT_GT(PrintedCell(plain).up, 0.0) << plain;
    EXPECT_EQ(PrintedCell(plain).dynamicity, 0.0);
    EXPECT_TRUE(contains(plain, "of cascade 0"));
    EXPECT_TRUE(contains(live({"--live-rays", "32k", "--live-frames", "4"}), "the mean of 1.311e+05 rays"));
    EXPECT_NE(live({"--live-storage", "sh1"}), plain);
    EXPECT_NE(live({"--live-resolution", "16"}), plain);
    const std::string lower = live({"--lamp", "lamp=0.2,0.3,0.2"});
    EXPECT_GT(std::abs(PrintedCell(lower).up - PrintedCell(plain).up), 0.05 * PrintedCell(plain).up);
    // The second of two cascades begins where the first one ends, near the camera outside of the box.
    EXPECT_TRUE(contains(live({"--live-cascades", "2", "--live-rays", "64k", "--live-frames", "2"}), "of cascade"));
    const std::string motion = write("m.json", R"({"fps": 30, "lights": [{"name": "lamp", "keys": [{"frame": 0, "position": [0.2, 0.5, 0.2]}, {"frame": 7, "position": [0.3, 0.5, 0.3]}]}]})");
    EXPECT_EQ(PrintedCell(live({"--motion", motion})).dynamicity, 1.0);
}

TEST_F(VizUsage, badOptionsOfLiveLightGiveOneLine) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> bad = {{{"--live"}, "--scene"},
                                                                               {{"--scene", "cornell"}, "--live"},
                                                                               {{"--live", "--scene", "cornell", "--lamp", "sun=0,0,0"}, "lamp"},
                                                                               {{"--live", "--scene", "cornell", "--lamp", "lamp=0,0"}, "NAME=x,y,z"},
                                                                               {{"--live", "--scene", "cornell", "--live-cascades", "9"}, "--live-cascades"},
                                                                               {{"--live", "--scene", "cornell", "--still-time", "0"}, "--still-time"},
                                                                               {{"--live", "--scene", "cornell", "--motion", "none.json"}, "none.json"},
                                                                               {{"V.vtm", "--live-rays", "64k"}, "--live"}};
    for (auto [arguments, expected] : bad) {
        arguments.insert(arguments.end(), {"--out", file("p.png")});
        const CommandResult result = runViz(arguments);
        EXPECT_EQ(result.status, 2) << expected;
        EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
        EXPECT_TRUE(contains(result.err, expected)) << result.err;
    }
    EXPECT_EQ(listing(), std::vector<std::string>{});
}

TEST_F(VizUsage, anotherSceneThanTheVolumesIsRefusedInOneLine) {
    const Scene cornell = loadScene("cornell");
    Scene copy = cornell, other = cornell;
    other.triangles.pop_back(), other.materialOf.pop_back(), other.nodeOf.pop_back();
    writeGlb(copy, file("same.glb"));
    writeGlb(other, file("other.glb"));
    const std::string volume = bake("cornell", 4);
    EXPECT_EQ(runViz({volume, "--scene", file("same.glb"), "--view", "mesh", "--size", "64x48", "--out", file("p.png")}).status, 0);
    for (const std::string& scene : {file("other.glb"), std::string("furnace_box"), std::string("two_rooms")}) {
        const CommandResult result = runViz({volume, "--scene", scene, "--view", "mesh", "--out", file("q.png")});
        EXPECT_EQ(result.status, 2) << scene;
        EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
        EXPECT_TRUE(contains(result.err, scene + ": expected the scene of the volume")) << result.err;
    }
}

}  // namespace
