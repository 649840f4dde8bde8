#include "bindings/scene/motion.h"

#include "scene/gltf_files.h"

namespace clv {
namespace {

class MotionFile : public TemporaryFolder {
protected:
    static Scene scene() {
        Scene scene = makeBuiltinScene("two_rooms");
        scene.anchor = {100.0, 0.0, 0.0};
        return scene;
    }
    Motion load(const std::string& text) const { return loadMotion(write("m.json", text), scene()); }
    std::string errorOf(const std::string& text) const {
        try {
            load(text);
        } catch (const InputError& error) {
            return error.what();
        }
        return {};
    }
};

TEST_F(MotionFile, valuesBetweenKeysAreLinearAndThoseOfTheEndsBeyond) {
    const Motion motion = load(R"({"fps": 30, "lights": [{"name": "lamp", "keys": [
        {"frame": 2, "position": [101, 2, 3], "intensity": [8, 8, 8]}, {"frame": 4, "intensity": [4, 2, 0]}, {"frame": 6, "position": [105, 2, 3]}]}]})");
    EXPECT_EQ(motion.fps, 30.0);
    EXPECT_EQ(motion.lastFrame, 6u);
    const auto lamp = [&](std::uint32_t frame) { return lightsAt(motion, scene(), frame)[0].light; };
    EXPECT_EQ(lamp(0).position, glm::vec3(1, 2, 3)) << "relative to the anchor";
    EXPECT_EQ(lamp(3).position, glm::vec3(2, 2, 3)) << "a key without a position does not hold it up";
    EXPECT_EQ(lamp(3).intensity, glm::vec3(6, 5, 4));
    EXPECT_EQ(lamp(5).intensity, glm::vec3(4, 2, 0));
    EXPECT_EQ(lamp(9).position, glm::vec3(5, 2, 3));
}

TEST_F(MotionFile, aLightIsDynamicInFramesInWhichItIsNotAsBefore) {
    const Motion motion = load(R"({"lights": [{"name": "lamp", "keys": [{"frame": 2, "position": [101, 2, 3]}, {"frame": 4, "position": [102, 2, 3]}]}]})");
    const float expected[] = {0.0f, 0.0f, 0.0f, 1.0f, 1.0f, 0.0f};
    for (std::uint32_t frame = 0; frame < 6; ++frame) EXPECT_EQ(lightsAt(motion, scene(), frame)[0].light.dynamicity, expected[frame]) << frame;
}

TEST_F(MotionFile, directionsStayOfUnitLengthEvenBetweenOppositeOnes) {
    const Motion motion = load(R"({"lights": [{"name": "lamp", "keys": [{"frame": 0, "direction": [0, 0, 5]}, {"frame": 2, "direction": [0, 0, -1]}]}]})");
    for (std::uint32_t frame = 0; frame < 3; ++frame) EXPECT_FLOAT_EQ(glm::length(lightsAt(motion, scene(), frame)[0].light.direction), 1.0f);
    EXPECT_EQ(lightsAt(motion, scene(), 0)[0].light.direction, glm::vec3(0, 0, 1));
}

TEST_F(MotionFile, aCameraLooksAtItsTargetAlsoStraightDown) {
    const Motion motion = load(R"({"camera": {"keys": [{"frame": 0, "position": [100, 1, 0], "target": [103, 1, 4], "yfov": 0.5}, {"frame": 2, "target": [100, 0, 0]}]}})");
    const Camera otherwise{.name = "eye", .aspect = 2.0f};
    const Camera first = cameraAt(motion, scene(), otherwise, 0), last = cameraAt(motion, scene(), otherwise, 2);
    EXPECT_EQ(first.name, "eye");
    EXPECT_EQ(first.position, glm::vec3(0, 1, 0));
    EXPECT_LT(glm::distance(first.forward, glm::vec3(0.6f, 0, 0.8f)), 1e-6f);
    EXPECT_LT(glm::distance(first.up, glm::vec3(0, 1, 0)), 1e-6f);
    EXPECT_EQ(first.yfov, 0.5f);
    EXPECT_EQ(first.aspect, 2.0f);
    EXPECT_LT(glm::distance(last.forward, glm::vec3(0, -1, 0)), 1e-6f);
    EXPECT_NEAR(glm::dot(last.up, last.forward), 0.0f, 1e-6f);
    EXPECT_NEAR(glm::length(last.up), 1.0f, 1e-6f);
}

TEST_F(MotionFile, everyMistakeIsNamedWithItsPlace) {
    const std::pair<const char*, const char*> mistakes[] = {
        {"", "well-formed JSON"},
        {R"([])", "an object"},
        {R"({})", "lights or a camera that move"},
        {R"({"sky": 1})", "'sky'"},
        {R"({"objects": []})", "objects: expected no objects"},
        {R"({"fps": 0, "lights": []})", "fps: expected a number from 1e-6 to 1e6"},
        {R"({"fps": 1e-300, "lights": []})", "fps: expected a number from 1e-6 to 1e6"},
        {R"({"lights": [{"name": "sun", "keys": []}]})", "lights[0].name: expected one of the scene's lights: lamp"},
        {R"({"lights": [{"name": "lamp"}]})", "lights[0]: expected a member 'keys'"},
        {R"({"lights": [{"name": "lamp", "keys": []}]})", "lights[0].keys: expected at least one key"},
        {R"({"lights": [{"name": "lamp", "keys": [{"position": [0,0,0]}]}]})", "lights[0].keys[0]: expected a member 'frame'"},
        {R"({"lights": [{"name": "lamp", "keys": [{"frame": 0.5}]}]})", "lights[0].keys[0].frame: expected a whole number"},
        {R"({"lights": [{"name": "lamp", "keys": [{"frame": 3}, {"frame": 3}]}]})", "lights[0].keys[1].frame: expected a frame after 3"},
        {R"({"lights": [{"name": "lamp", "keys": [{"frame": 0, "position": [0,0]}]}]})", "lights[0].keys[0].position: expected 3 numbers"},
        {R"({"lights": [{"name": "lamp", "keys": [{"frame": 0, "position": [0,0,1.1e12]}]}]})", "lights[0].keys[0].position: expected coordinates of at most 1e+12 m"},
        {R"({"camera": {"keys": [{"frame": 0, "position": [1e30,0,0]}]}})", "camera.keys[0].position: expected coordinates of at most 1e+12 m"},
        {R"({"camera": {"keys": [{"frame": 0, "target": [0,-1e30,0]}]}})", "camera.keys[0].target: expected coordinates of at most 1e+12 m"},
        {R"({"lights": [{"name": "lamp", "keys": [{"frame": 0, "direction": [0,0,0]}]}]})", "lights[0].keys[0].direction"},
        {R"({"lights": [{"name": "lamp", "keys": [{"frame": 0, "intensity": [1,-1,0]}]}]})", "lights[0].keys[0]: intensity -1"},
        {R"({"lights": [{"name": "lamp", "keys": [{"frame": 0, "colour": 1}]}]})", "'colour'"},
        {R"({"lights": [{"name": "lamp", "keys": [{"frame": 0}]}, {"name": "lamp", "keys": [{"frame": 0}]}]})", "lights[1].name"},
        {R"({"camera": {"keys": [{"frame": 0, "yfov": 4}]}})", "camera.keys[0].yfov: expected an angle"},
        {R"({"camera": {"keys": [{"frame": 0, "yfov": 1e-300}]}})", "camera.keys[0].yfov: expected an angle"},
        {R"({"camera": {"keys": [{"frame": 0, "roll": 4}]}})", "'roll'"},
        {R"({"camera": {"keys": [{"frame": 0, "yfov": 1, "frame": 1}]}})", "expected 'frame' once in its object"},
    };
    for (const auto& [text, expected] : mistakes) {
        const std::string error = errorOf(text);
        EXPECT_EQ(error.rfind(file("m.json"), 0), 0u) << text << "\n" << error;
        EXPECT_NE(error.find(expected), std::string::npos) << text << "\n" << error;
    }
}

}  // namespace
}  // namespace clv
