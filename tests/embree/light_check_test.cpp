#include "bindings/embree/light_check.h"

#include <gtest/gtest.h>

#include "bindings/scene/scene.h"
#include "embree/small_scenes.h"

namespace clv::test {
namespace {

TEST(LightCheck, findsNothingAmissInTheBuiltInScenes) {
    for (const BuiltinScene& builtin : builtinScenes()) {
        const Scene scene = makeBuiltinScene(builtin.name);
        const LightCheck check = checkLights(EmbreeScene(scene), serialFor());
        EXPECT_TRUE(check.idle.empty()) << builtin.name;
        EXPECT_LE(check.shareOnBacks, 0.05) << builtin.name;
    }
}

TEST(LightCheck, seesThatASceneIsInsideOut) {
    Scene scene = makeBuiltinScene("furnace_box");
    turnFaces(scene);
    EXPECT_GE(checkLights(EmbreeScene(scene), serialFor()).shareOnBacks, 0.999);
}

TEST(LightCheck, knowsHowNearSurfacesAre) {
    SmallScene room;
    room.rectangle({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, room.material(glm::vec3(0.5f)));
    room.light(makePointLight(glm::vec3(1.0f)), {0, 0.01, 0});
    room.light(makePointLight(glm::vec3(1.0f)), {0, 10, 0});
    room.light(makeDirectionalLight({0, -1, 0}, glm::vec3(1.0f)), {0, 0, 0});
    const Scene scene = room.finish();
    const LightCheck check = checkLights(EmbreeScene(scene), serialFor());
    ASSERT_EQ(check.reach.size(), 3u);
    EXPECT_NEAR(check.reach[0], 0.02, 0.001) << "a quarter of the sphere lies within 60 degrees of straight down";
    EXPECT_NEAR(check.reach[1], 10.0, 0.1) << "of what is sent towards the scene";
    EXPECT_EQ(check.reach[2], kClvFar);
}

TEST(LightCheck, namesTheLightsThatMeetNothing) {
    SmallScene room;
    room.rectangle({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, room.material(glm::vec3(0.5f)));
    room.light(makeSpotLight({0, 1, 0}, glm::vec3(1.0f), 0.1f, 0.2f), {0, 1, 0});
    Scene scene = room.finish();
    scene.lights[0].name = "upwards";
    EXPECT_EQ(checkLights(EmbreeScene(scene), serialFor()).idle, std::vector<std::string>{"upwards"});
    scene.lights[0].light.direction = glm::vec3(0, -1, 0);
    EXPECT_TRUE(checkLights(EmbreeScene(scene), serialFor()).idle.empty());
    scene.lights[0].light.direction = glm::vec3(0, 1, 0);
    scene.lights[0].light.intensity = glm::vec3(0.0f);  // off
    EXPECT_TRUE(checkLights(EmbreeScene(scene), serialFor()).idle.empty());
}

}  // namespace
}  // namespace clv::test
