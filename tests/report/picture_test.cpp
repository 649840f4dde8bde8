// What a camera sees lands in the right pixel.
#include "benchmarks/report/picture.h"

#include <cmath>

#include <gtest/gtest.h>

#include "clv/math/constants.h"

namespace {

using namespace clv;

// A wall at z = -2 that spans x in [0, 10], y in [0, 10], seen from the origin along -z: it fills the upper right quarter.
Scene quarterWall() {
    Scene scene;
    scene.name = "quarter";
    scene.positions = {{0, 0, -2}, {10, 0, -2}, {10, 10, -2}, {0, 10, -2}};
    scene.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.materialOf = {0, 0};
    scene.nodeOf = {0, 0};
    scene.nodeNames = {"wall"};
    scene.materials = {{.name = "paint", .albedo = {0.5f, 0.25f, 1.0f}}};
    scene.bounds = {{0, 0, -2}, {10, 10, -2}};
    scene.cameras = {{.name = "front", .yfov = 0.5f * kClvPi}, {.name = "7"}};
    return scene;
}

TEST(Picture, picturesHaveRightOnTheRightAndUpAtTheTop) {
    const Scene scene = quarterWall();
    const EmbreeScene embree(scene);
    const auto surfaces = visibleSurfaces(embree, scene.cameras[0], 4, 2, serialFor());
    ASSERT_EQ(surfaces.size(), 2u);
    EXPECT_EQ(surfaces[0].pixel, 2u);
    EXPECT_EQ(surfaces[1].pixel, 3u);
    // The upper row's centre is half way to the top edge, which the camera sees at 45 degrees; pixels are square.
    EXPECT_NEAR(glm::distance(surfaces[0].point.position, glm::vec3(1, 1, -2)), 0.0f, 1e-5f);
    EXPECT_NEAR(glm::distance(surfaces[1].point.position, glm::vec3(3, 1, -2)), 0.0f, 1e-5f);
    EXPECT_NEAR(glm::distance(surfaces[0].point.normal, glm::vec3(0, 0, 1)), 0.0f, 1e-6f);
    EXPECT_NEAR(glm::distance(surfaces[0].albedo, glm::vec3(0.5f, 0.25f, 1.0f)), 0.0f, 1e-6f);
}

TEST(Picture, radianceIsAlbedoTimesIrradianceOverPiAndBlackElsewhere) {
    const Scene scene = quarterWall();
    const EmbreeScene embree(scene);
    const auto surfaces = visibleSurfaces(embree, scene.cameras[0], 4, 2, serialFor());
    const std::vector<glm::vec3> irradiance = {glm::vec3(kClvPi), glm::vec3(2 * kClvPi)};
    const Image image = radianceImage(4, 2, surfaces, irradiance);
    EXPECT_NEAR(glm::distance(image.at(2, 0), glm::vec3(0.5f, 0.25f, 1.0f)), 0.0f, 1e-6f);
    EXPECT_NEAR(glm::distance(image.at(3, 0), glm::vec3(1.0f, 0.5f, 2.0f)), 0.0f, 1e-6f);
    for (int x = 0; x < 4; ++x) EXPECT_EQ(image.at(x, 1), glm::vec3(0.0f));
}

TEST(Picture, errorsAreThoseOfBlocksOfPixelsAndNotANumberWhereNothingIsSeen) {
    std::vector<VisibleSurface> surfaces;
    for (std::size_t pixel : {0, 1, 2, 3, 4}) surfaces.push_back({pixel, {}, {}});
    // A picture of 4 x 2 in blocks of 2: pixels 0, 1 and 4 share one, in which the errors cancel.
    const std::vector<glm::vec3> truth(5, glm::vec3(1, 0, 0));
    const std::vector<glm::vec3> estimate = {{1.5f, 0, 0}, {0.5f, 0, 0}, {2, 0, 0}, {1.5f, 0, 0}, {1, 0, 0}};
    const std::vector<float> map = blockErrors(4, 2, 2, surfaces, estimate, truth);
    ASSERT_EQ(map.size(), 8u);
    EXPECT_NEAR(map[0], 0.0f, 1e-6f);
    EXPECT_NEAR(map[4], 0.0f, 1e-6f);
    EXPECT_NEAR(map[2], 0.75f, 1e-6f);
    EXPECT_EQ(map[2], map[3]);
    for (int pixel : {5, 6, 7}) EXPECT_TRUE(std::isnan(map[std::size_t(pixel)]));
}

}  // namespace
