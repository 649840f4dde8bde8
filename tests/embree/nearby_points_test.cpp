// Points beside given ones: on the surfaces that carry on from theirs, and in sight.
#include <algorithm>
#include <functional>

#include <gtest/gtest.h>

#include "bindings/embree/nearby_points.h"
#include "embree/small_scenes.h"

namespace clv::test {
namespace {

const std::vector<ClvReceiver> kMiddle = {{{0, 0, 0}, 0.0f, {0, 1, 0}, 0.0f}};

// The floor y = 0 between x, z = -5 and 5.
Scene floorWith(const std::function<void(SmallScene&, int material)>& more) {
    SmallScene small;
    const int grey = small.material(glm::vec3(0.5f));
    small.rectangle({-5, 0, -5}, {0, 0, 10}, {10, 0, 0}, grey);
    more(small, grey);
    return small.finish();
}

TEST(NearbyPoints, fillADiskOnAPlane) {
    const Scene scene = floorWith([](SmallScene&, int) {});
    const auto points = nearbyPoints(EmbreeScene(scene), kMiddle, 2.0f, 1000, 1);
    ASSERT_EQ(points.size(), 1000u);
    double square = 0.0;
    glm::vec3 mean(0.0f);
    for (const ClvReceiver& p : points) {
        EXPECT_NEAR(p.position.y, 0.0f, 1e-5f);
        EXPECT_NEAR(p.normal.y, 1.0f, 1e-5f);
        EXPECT_LT(glm::length(p.position), 2.0f + 1e-5f);
        square += dot(p.position, p.position), mean += p.position / 1000.0f;
    }
    EXPECT_NEAR(square / 1000.0, 2.0, 0.02);  // half the square of the radius: spread evenly
    EXPECT_LT(glm::length(mean), 0.02f);
}

TEST(NearbyPoints, stayOnThisSideOfAWall) {
    const Scene scene = floorWith([](SmallScene& small, int grey) {
        small.rectangle({1, -1, -5}, {0, 3, 0}, {0, 0, 10}, grey);
    });
    const auto points = nearbyPoints(EmbreeScene(scene), kMiddle, 2.0f, 500, 1);
    ASSERT_EQ(points.size(), 500u);
    for (const ClvReceiver& p : points) EXPECT_LT(p.position.x, 1.0f);
}

TEST(NearbyPoints, leaveOutStepsAndSurfacesThatTurnAway) {
    const Scene scene = floorWith([](SmallScene& small, int grey) {
        small.rectangle({1, 0.6f, -5}, {0, 0, 10}, {4, 0, 0}, grey);     // higher than a quarter of the radius
        small.rectangle({-5, 4, -5}, {0, 0, 10}, {4, -4, 0}, grey);      // a slope of 45 degrees down to x = -1
    });
    for (const ClvReceiver& p : nearbyPoints(EmbreeScene(scene), kMiddle, 2.0f, 500, 1)) {
        EXPECT_NEAR(p.position.y, 0.0f, 1e-5f);
        EXPECT_GT(p.normal.y, 0.99f);
    }
}

TEST(NearbyPoints, areSharedBetweenThePoints) {
    const Scene scene = floorWith([](SmallScene&, int) {});
    const std::vector<ClvReceiver> two = {{{-3, 0, 0}, 0.0f, {0, 1, 0}, 0.0f}, {{3, 0, 0}, 0.0f, {0, 1, 0}, 0.0f}};
    const auto points = nearbyPoints(EmbreeScene(scene), two, 1.0f, 100, 1);
    EXPECT_EQ(std::ranges::count_if(points, [](const ClvReceiver& p) { return p.position.x > 0.0f; }), 50);
}

TEST(NearbyPoints, areFewerWhereThereIsNoRoom) {
    SmallScene small;
    small.rectangle({-5, 0, -5}, {0, 0, 10}, {10, 0, 0}, small.material(glm::vec3(0.5f)));
    const Scene scene = small.finish();
    const EmbreeScene embree(scene);
    const std::vector<ClvReceiver> beside = {{{20, 0, 0}, 0.0f, {0, 1, 0}, 0.0f}};
    EXPECT_TRUE(nearbyPoints(embree, beside, 1.0f, 100, 1).empty());
    EXPECT_TRUE(nearbyPoints(embree, {}, 1.0f, 100, 1).empty());
    EXPECT_TRUE(nearbyPoints(embree, kMiddle, 1.0f, 0, 1).empty());
}

}  // namespace
}  // namespace clv::test
