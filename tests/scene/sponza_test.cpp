#include <filesystem>

#include <gtest/gtest.h>

#include "bindings/scene/scene.h"

namespace clv {
namespace {

TEST(SponzaLow, loadsWithItsTrianglesSunAndCameras) {
    const std::string file = CLV_SOURCE_DIR "/../shared/scenes/sponza_low.glb";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "the scene is not here: " << file;
    const Scene scene = loadScene(file);
    EXPECT_EQ(scene.triangles.size() + scene.droppedTriangles, 758u);
    EXPECT_EQ(scene.droppedTriangles, 0u);
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].light.type, kClvLightDirectional);
    EXPECT_LT(glm::distance(scene.lights[0].light.direction, glm::normalize(glm::vec3(0.35f, -1.0f, 0.22f))), 1e-5f);
    EXPECT_LT(glm::distance(scene.lights[0].light.intensity, glm::vec3(10.0f, 9.5f, 8.6f)), 1e-5f);
    ASSERT_EQ(scene.cameras.size(), 11u);
    EXPECT_EQ(scene.cameras.front().name, "thesis_camera_00");
    EXPECT_EQ(scene.cameras.back().name, "thesis_camera_10");
    EXPECT_LT(glm::distance(scene.cameras.back().position, glm::vec3(-10.69353f, 5.446158f, 1.165829f)), 1e-5f);
    EXPECT_EQ(scene.materials.at(0).name, "stone");
}

}  // namespace
}  // namespace clv
