// What clv-viz says to bad usage, and what it prints of a typed position.
#include "viz/viz_command.h"

using namespace clv;
using namespace clv::test;

namespace {

class VizUsage : public VizCommand {};

TEST_F(VizUsage, badOptionsGiveOneLineThatSaysWhatWasExpected) {
    const std::string volume = bake("cornell", 4);
    const std::vector<std::vector<std::string>> bad = {{"--slice", "w=1"},      {"--size", "10"},         {"--view", "nothing"}, {"--pick", "1,2"},
                                                       {"--pick", "0,0,0,1,1,0"}, {"--range", "2,1"},       {"--camera", "roof"},  {"--camera", "0,0,0,0,0,0"},
                                                       {"--cascade", "9"},        {"--scene", "nowhere.glb"}, {"--exposure", "nan"}};
    for (std::vector<std::string> arguments : bad) {
        arguments.insert(arguments.begin(), {volume, "--out", file("p.png")});
        const CommandResult result = runViz(arguments);
        EXPECT_EQ(result.status, 2) << arguments[3] << " " << arguments[4];
        EXPECT_TRUE(result.err.starts_with("clv-viz: ")) << result.err;
        EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << arguments[3] << " " << result.err;
        EXPECT_FALSE(std::filesystem::exists(file("p.png"))) << arguments[3];
    }
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

}  // namespace
