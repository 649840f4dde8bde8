#include "bindings/embree/tight_frame.h"

#include <cmath>

#include <gtest/gtest.h>

#include "bindings/embree/embree_scene.h"
#include "clv/math/sampling.h"
#include "embree/small_scenes.h"

namespace clv::test {
namespace {

// A box of half sides 1, 2 and 3 along the columns of `axes`, each wall cut into 8 x 8 rectangles.
Scene boxAlong(const glm::dmat3& axes, const glm::dvec3& center = glm::dvec3(0.0)) {
    SmallScene small;
    const std::uint32_t grey = small.material(glm::vec3(0.5f));
    constexpr int kCuts = 8;
    for (int axis = 0; axis < 3; ++axis) {
        const auto side = [&](int k) { return axes[(axis + k) % 3] * double(1 + (axis + k) % 3); };
        for (double sign : {-1.0, 1.0}) {
            const glm::dvec3 u = side(1), v = sign * side(2);
            for (int i = 0; i < kCuts; ++i) {
                for (int j = 0; j < kCuts; ++j) {
                    small.rectangle(center + sign * side(0) + u * (2.0 * i / kCuts - 1.0) + v * (2.0 * j / kCuts - 1.0), u * (2.0 / kCuts),
                                    v * (2.0 / kCuts), grey);
                }
            }
        }
    }
    return small.finish();
}

glm::dmat3 askew() {
    const double a = 0.5, b = 0.35;
    const glm::dmat3 aboutY(glm::dvec3(std::cos(a), 0, -std::sin(a)), glm::dvec3(0, 1, 0), glm::dvec3(std::sin(a), 0, std::cos(a)));
    const glm::dmat3 aboutX(glm::dvec3(1, 0, 0), glm::dvec3(0, std::cos(b), std::sin(b)), glm::dvec3(0, -std::sin(b), std::cos(b)));
    return aboutY * aboutX;
}

TEST(TightFrame, anUprightSceneKeepsItsCoordinatesToTheLastBit) {
    const Scene scene = boxAlong(glm::dmat3(1.0), {0.1, 20.3, -7.7});
    const TightFrame frame = findTightFrame(scene);
    for (const glm::vec3& p : scene.positions) EXPECT_EQ(frame.point(p), p);
    const glm::vec3 d = randomDirection(3, 0);
    EXPECT_EQ(frame.direction(d), d);
}

TEST(TightFrame, aSceneWithoutPreferredDirectionsIsNotTurned) {
    const TightFrame frame = findTightFrame(triangleSoup(3000, 0.2f, 5));
    EXPECT_EQ(frame.rotation, glm::mat3(1.0f));
}

TEST(TightFrame, aBoxThatStandsAskewIsTurnedUpright) {
    const glm::dmat3 axes = askew();
    const TightFrame frame = findTightFrame(boxAlong(axes, {4, 5, 6}));
    for (int axis = 0; axis < 3; ++axis) {
        const glm::vec3 turned = glm::abs(frame.direction(glm::vec3(axes[axis])));
        EXPECT_NEAR(std::max({turned.x, turned.y, turned.z}), 1.0f, 1e-6f);
    }
    EXPECT_NEAR(glm::determinant(frame.rotation), 1.0f, 1e-6f);  // a mirrored frame would turn fronts into backs
    EXPECT_LT(glm::length(frame.point({4, 5, 6})), 1e-5f);
}

TEST(TightFrame, raysInAnAskewSceneAreCutWhereTheWatertightQueriesCutThem) {
    for (double distance : {0.0, 1000.0}) {
        const glm::dvec3 center = distance * glm::dvec3(1, -1, 1);
        const Scene scene = boxAlong(askew(), center);
        ASSERT_NE(findTightFrame(scene).rotation, glm::mat3(1.0f));
        const EmbreeScene embree(scene);
        std::vector<ClvRay> rays;
        for (uint i = 0; i < 20000; ++i) {
            // From a wall, as light leaves it: such a ray must not meet its own wall either.
            const glm::vec3 from = glm::vec3(center);
            const glm::vec3 toWall = randomDirection(61, i);
            const ClvHit wall = embree.hit(from, toWall, kClvFar);
            ASSERT_LT(wall.distance, kClvFar);
            rays.push_back(rayAlong(from + toWall * wall.distance + wall.normal * embree.surfaceOffset(),
                                    clvCosineFromSquare(vec2(randomUnit(62, 2 * i), randomUnit(62, 2 * i + 1)), wall.normal)));
        }
        std::vector<ClvRay> cut = rays;
        embree.trace(cut);
        const float rounding = embree.surfaceOffset();
        int atGrazing = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const ClvHit hit = embree.hit(rays[i].origin, rays[i].direction, kClvFar);
            // Along a ray that grazes a surface the rounding of coordinates shows at its slope.
            const float slope = std::abs(glm::dot(hit.normal, rays[i].direction));
            atGrazing += slope < 0.01f;
            EXPECT_NEAR(cut[i].maxDistance, hit.distance, rounding / std::max(slope, 1e-6f)) << i << " at " << distance;
        }
        EXPECT_LT(atGrazing, 200);
    }
}

}  // namespace
}  // namespace clv::test
