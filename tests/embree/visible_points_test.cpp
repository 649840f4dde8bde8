// Points that cameras see: on surfaces, facing the camera, shared evenly between the cameras.
#include <gtest/gtest.h>

#include "bindings/embree/visible_points.h"
#include "embree/small_scenes.h"

namespace clv::test {
namespace {

Camera cameraAt(const glm::vec3& position, const glm::vec3& forward, const glm::vec3& up) {
    Camera camera;
    camera.position = position;
    camera.forward = forward;
    camera.up = up;
    camera.yfov = 1.0f;
    camera.aspect = 1.5f;
    return camera;
}

// The floor y = 0 between x, z = -5 and 5.
Scene floorSeenBy(std::vector<Camera> cameras) {
    SmallScene small;
    small.rectangle({-5, 0, -5}, {0, 0, 10}, {10, 0, 0}, small.material(glm::vec3(0.5f)));
    Scene scene = small.finish();
    scene.cameras = std::move(cameras);
    return scene;
}

const Camera kAbove = cameraAt({0, 2, 0}, {0, -1, 0}, {0, 0, -1}), kBelow = cameraAt({0, -2, 0}, {0, 1, 0}, {0, 0, -1});

TEST(VisiblePoints, fillThePictureOfTheCamera) {
    const Scene scene = floorSeenBy({kAbove});
    const auto points = visiblePoints(EmbreeScene(scene), 1000, 1);
    ASSERT_EQ(points.size(), 1000u);
    const float halfHeight = 2.0f * std::tan(0.5f), halfWidth = 1.5f * halfHeight;
    glm::vec2 most(0.0f);
    for (const ClvReceiver& p : points) {
        EXPECT_NEAR(p.position.y, 0.0f, 1e-5f);
        EXPECT_NEAR(p.normal.y, 1.0f, 1e-5f);
        most = glm::max(most, glm::abs(glm::vec2(p.position.x, p.position.z)));
    }
    EXPECT_LE(most.x, halfWidth * 1.0001f);
    EXPECT_LE(most.y, halfHeight * 1.0001f);
    EXPECT_GT(most.x, 0.98f * halfWidth);
    EXPECT_GT(most.y, 0.98f * halfHeight);
}

TEST(VisiblePoints, areSharedBetweenTheCamerasAndFaceThem) {
    const Scene scene = floorSeenBy({kAbove, kBelow});
    const auto points = visiblePoints(EmbreeScene(scene), 400, 1);
    int up = 0, down = 0;
    for (const ClvReceiver& p : points) (p.normal.y > 0.0f ? up : down)++;
    EXPECT_EQ(up, 200);
    EXPECT_EQ(down, 200);
}

TEST(VisiblePoints, aCameraThatLooksPastTheSceneSeesNothing) {
    const Scene none = floorSeenBy({}), sky = floorSeenBy({cameraAt({0, 2, 0}, {0, 1, 0}, {0, 0, -1})});
    EXPECT_TRUE(visiblePoints(EmbreeScene(none), 100, 1).empty());
    EXPECT_TRUE(visiblePoints(EmbreeScene(sky), 100, 1).empty());
}

TEST(VisiblePoints, aPictureThatIsHalfSkyStillGivesAllPoints) {
    // Level with the horizon: the upper half of the picture is sky.
    const Scene scene = floorSeenBy({cameraAt({0, 0.5f, 4.9f}, {0, 0, -1}, {0, 1, 0})});
    EXPECT_EQ(visiblePoints(EmbreeScene(scene), 300, 1).size(), 300u);
}

}  // namespace
}  // namespace clv::test
