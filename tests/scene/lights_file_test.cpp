#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

#include "scene/gltf_files.h"

namespace clv {
namespace {

class LightsFile : public TemporaryFolder {
protected:
    std::string errorOf(const std::string& text) const {
        try {
            loadLights(write("lights.json", text), glm::dvec3(0.0));
        } catch (const InputError& error) {
            return error.what();
        }
        return {};
    }
};

TEST_F(LightsFile, readsTheThreeKindsRelativeToTheAnchor) {
    const std::string path = write("lights.json", R"({"lights": [
        {"name": "lamp", "type": "point", "position": [1000001, 2, 3], "intensity": [1, 2, 3]},
        {"type": "spot", "position": [1000000, 0, 0], "direction": [0, -2, 0], "intensity": [4, 5, 6], "innerConeAngle": 0.1, "outerConeAngle": 0.2},
        {"type": "directional", "direction": [3, 0, 4], "intensity": [0, 0, 0]}]})");
    const std::vector<NamedLight> lights = loadLights(path, {1000000, 0, 0});
    ASSERT_EQ(lights.size(), 3u);
    EXPECT_EQ(lights[0].name, "lamp");
    EXPECT_EQ(lights[0].light.type, kClvLightPoint);
    EXPECT_EQ(lights[0].light.position, glm::vec3(1, 2, 3));
    EXPECT_EQ(lights[0].light.intensity, glm::vec3(1, 2, 3));
    EXPECT_EQ(lights[1].name, "light 1");
    EXPECT_EQ(lights[1].light.type, kClvLightSpot);
    EXPECT_EQ(lights[1].light.direction, glm::vec3(0, -1, 0)) << "made a unit vector";
    EXPECT_FLOAT_EQ(lights[1].light.innerConeAngle, 0.1f);
    EXPECT_FLOAT_EQ(lights[1].light.outerConeAngle, 0.2f);
    EXPECT_EQ(lights[2].light.type, kClvLightDirectional);
    EXPECT_LT(glm::distance(lights[2].light.direction, glm::vec3(0.6f, 0, 0.8f)), 1e-6f);
}

TEST_F(LightsFile, aSpotWithoutAnglesHasThoseOfGltf) {
    const std::string path = write("lights.json", R"({"lights": [{"type": "spot", "position": [0,0,0], "direction": [0,-1,0], "intensity": [1,1,1]}]})");
    const ClvLight light = loadLights(path, glm::dvec3(0.0)).at(0).light;
    EXPECT_EQ(light.innerConeAngle, 0.0f);
    EXPECT_FLOAT_EQ(light.outerConeAngle, glm::quarter_pi<float>());
}

TEST_F(LightsFile, rangesPlayNoPart) {
    const std::string text = R"({"lights": [{"type": "point", "position": [0,0,0], "intensity": [1,2,3], "range": 5},
        {"type": "spot", "position": [0,0,0], "direction": [0,-1,0], "intensity": [1,1,1], "range": 0.1},
        {"type": "directional", "direction": [0,-1,0], "intensity": [1,1,1], "range": 1}]})";
    const std::vector<NamedLight> lights = loadLights(write("lights.json", text), glm::dvec3(0.0));
    ASSERT_EQ(lights.size(), 3u);
    EXPECT_EQ(lights[0].light.intensity, glm::vec3(1, 2, 3));
}

TEST_F(LightsFile, anEmptyListIsNoLight) { EXPECT_TRUE(loadLights(write("l.json", R"({"lights": []})"), glm::dvec3(0.0)).empty()); }

TEST_F(LightsFile, everyMistakeIsNamedWithItsPlace) {
    const std::pair<const char*, const char*> mistakes[] = {
        {"", "well-formed JSON"},
        {R"({"lights": [)", "well-formed JSON"},
        {R"([])", "an object"},
        {R"({})", "'lights'"},
        {R"({"lights": {}})", "lights: expected an array"},
        {R"({"lights": [], "lights": []})", "expected 'lights' once in its object"},
        {R"({"lights": [{"type": "point", "position": [0,0,0], "intensity": [1,1,1], "position": [1,1,1]}]})", "expected 'position' once in its object"},
        {R"({"lights": [], "sky": 1})", "'sky'"},
        {R"({"lights": [{}]})", "lights[0]: expected a member 'type'"},
        {R"({"lights": [{"type": "area"}]})", "lights[0].type"},
        {R"({"lights": [{"type": "point", "intensity": [1,1,1]}]})", "lights[0]: expected a member 'position'"},
        {R"({"lights": [{"type": "point", "position": [0,0,0]}]})", "lights[0]: expected a member 'intensity'"},
        {R"({"lights": [{"type": "spot", "position": [0,0,0], "intensity": [1,1,1]}]})", "lights[0]: expected a member 'direction'"},
        {R"({"lights": [{"type": "directional", "intensity": [1,1,1]}]})", "lights[0]: expected a member 'direction'"},
        {R"({"lights": [{"type": "point", "position": [0,0,0], "intensity": [1,1,1], "colour": 1}]})", "'colour'"},
        {R"({"lights": [{"type": "point", "position": [0,0,0], "intensity": [1,1,1], "outerConeAngle": 1}]})", "'outerConeAngle'"},
        {R"({"lights": [{"type": "point", "position": [0,0], "intensity": [1,1,1]}]})", "lights[0].position: expected 3 numbers"},
        {R"({"lights": [{"type": "point", "position": [0,0,"a"], "intensity": [1,1,1]}]})", "lights[0].position[2]: expected a number"},
        {R"({"lights": [{"type": "point", "position": [0,0,1.1e12], "intensity": [1,1,1]}]})", "lights[0].position: expected coordinates of at most 1e+12 m"},
        {R"({"lights": [{"type": "point", "position": [0,0,0], "intensity": [1,-1,1]}]})", "lights[0]: intensity -1"},
        {R"({"lights": [{"type": "point", "position": [0,0,0], "intensity": [1,1e39,1]}]})", "lights[0]: intensity inf"},
        {R"({"lights": [{"type": "point", "position": [0,0,0], "intensity": [1,1e999,1]}]})", "fit into a double"},
        {R"({"lights": [{"type": "directional", "direction": [0,0,0], "intensity": [1,1,1]}]})", "lights[0].direction"},
        {R"({"lights": [{"type": "spot", "position": [0,0,0], "direction": [0,1,0], "intensity": [1,1,1], "innerConeAngle": 0.5, "outerConeAngle": 0.5}]})",
         "lights[0]: cone angles"},
    };
    for (const auto& [text, expected] : mistakes) {
        const std::string error = errorOf(text);
        EXPECT_EQ(error.rfind(file("lights.json"), 0), 0u) << text << "\n" << error;
        EXPECT_NE(error.find(expected), std::string::npos) << text << "\n" << error;
    }
}

TEST_F(LightsFile, aMissingFileIsNamed) {
    EXPECT_THROW(loadLights(file("nowhere.json"), glm::dvec3(0.0)), InputError);
}

}  // namespace
}  // namespace clv
