// clv scenes and clv info from outside.
#include "bindings/scene/scene.h"

#include <nlohmann/json.hpp>

#include "cli/run_command.h"
#include "support/temporary_folder.h"

namespace {

using namespace clv;
using nlohmann::json;

class Scenes : public TemporaryFolder {};

TEST_F(Scenes, listsEveryBuiltInSceneWithItsNumbers) {
    const json report = json::parse(runCommand({"scenes", "--json"}).out);
    ASSERT_EQ(report.at("scenes").size(), builtinScenes().size());
    for (std::size_t i = 0; i < builtinScenes().size(); ++i) {
        const json& listed = report.at("scenes").at(i);
        EXPECT_EQ(listed.at("name"), builtinScenes()[i].name);
        EXPECT_EQ(listed.at("description"), builtinScenes()[i].description);
        const Scene scene = makeBuiltinScene(builtinScenes()[i].name);
        EXPECT_EQ(listed.at("triangles"), scene.triangles.size());
        EXPECT_EQ(listed.at("lights"), scene.lights.size());
        EXPECT_EQ(listed.at("cameras"), scene.cameras.size());
    }
}

TEST_F(Scenes, aTableForPeopleHasALineAScene) {
    const std::string text = runCommand({"scenes"}).out;
    for (const BuiltinScene& scene : builtinScenes()) EXPECT_NE(text.find("\n  " + scene.name + " "), std::string::npos) << text;
}

TEST_F(Scenes, aWrittenSceneLoadsWithTheSameGeometry) {
    const CommandResult result = runCommand({"scenes", "--write", file("cornell.glb"), "--json"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(json::parse(result.out).at("out"), file("cornell.glb"));
    EXPECT_EQ(listing(), std::vector<std::string>{"cornell.glb"});
    const Scene written = loadScene(file("cornell.glb")), original = makeBuiltinScene("cornell");
    EXPECT_EQ(written.triangles.size(), original.triangles.size());
    EXPECT_EQ(written.lights.size(), original.lights.size());
    EXPECT_EQ(written.cameras.size(), original.cameras.size());
}

TEST_F(Scenes, anUnknownNameOrKindOfFileIsRefused) {
    for (const char* name : {"castle.glb", "cornell.obj"}) {
        const CommandResult result = runCommand({"scenes", "--write", file(name)});
        EXPECT_EQ(result.status, 2);
        EXPECT_NE(result.err.find(std::filesystem::path(name).stem().string()), std::string::npos) << result.err;
    }
    EXPECT_EQ(listing(), std::vector<std::string>{});
}

TEST_F(Scenes, infoSaysWhatThereIs) {
    const json report = json::parse(runCommand({"info", "--json", "--threads", "3"}).out);
    EXPECT_EQ(report.at("threads"), 3);
    EXPECT_EQ(report.at("backends")[0], "cpu");
    EXPECT_GE(report.at("hardware_threads"), 1);
    EXPECT_TRUE(report.at("cpu_features").is_array());
}

}  // namespace
