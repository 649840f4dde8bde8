// Light propagation volumes: how light spreads, what stops it, and how far from the truth it stays.
#include <gtest/gtest.h>

#include "baselines/method_run.h"
#include "benchmarks/baselines/light_propagation.h"
#include "furnace/surface_points.h"

namespace clv::test {
namespace {

std::vector<glm::vec3> lightOf(const MeasuredRoom& room, const LightPropagationSettings& settings) {
    const auto method = makeLightPropagation(settings);
    method->prepare(room.world(), room.points);
    return lightAfter(*method, room, 1, 2, 1);
}

// Mean of the green channel where `chosen` says so.
template <class Chosen>
double meanWhere(const MeasuredRoom& room, const std::vector<glm::vec3>& light, const Chosen& chosen) {
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < light.size(); ++i) {
        if (chosen(room.points[i])) sum += light[i].y, ++count;
    }
    EXPECT_GT(count, 0);
    return sum / count;
}

TEST(LightPropagation, whiteSphereIsEvenAndLosesWhatWallsCutOff) {
    MeasuredRoom room("white_sphere");
    room.points = surfacePoints(room.scene, 300, 3);
    const std::vector<glm::vec3> truth(room.points.size(), glm::vec3(0.8 * 4.0 * M_PI / surfaceArea(room.scene)));
    const RelativeErrors errors = relativeErrors(lightOf(room, {.resolution = 8, .iterations = 16}), truth);
    // Cells that the wall cuts count as whole, and what two bands blur is stopped before it arrives.
    EXPECT_LT(errors.bias, -0.2);
    EXPECT_GT(errors.bias, -0.45);
    EXPECT_LT(std::sqrt(errors.rmse * errors.rmse - errors.bias * errors.bias), 0.1);
}

TEST(LightPropagation, staysFarFromTheTruthHoweverFineItIs) {
    const MeasuredRoom room("cornell", 400, 1024);
    LightPropagationSettings settings{.resolution = 8, .gridShift = glm::vec3(0.13f, 0.57f, 0.31f), .iterations = 16};
    const double coarse = relativeErrors(lightOf(room, settings), room.trueIrradiance()).rmse;
    EXPECT_LT(coarse, 0.7);
    settings.resolution = 16, settings.iterations = 32;
    EXPECT_GT(relativeErrors(lightOf(room, settings), room.trueIrradiance()).rmse, coarse);
}

TEST(LightPropagation, lightGetsAsManyCellsFarAsThereAreIterations) {
    const MeasuredRoom room("corridor", 300, 1);
    // The lamp hangs at the start; the end is some forty cells away.
    const auto atTheEnd = [](const ReferencePoint& p) { return p.position.z > 6.2f && p.position.x > 9.0f; };
    EXPECT_EQ(meanWhere(room, lightOf(room, {.resolution = 16, .iterations = 4}), atTheEnd), 0.0);
    EXPECT_GT(meanWhere(room, lightOf(room, {.resolution = 16, .iterations = 60, .damped = false}), atTheEnd), 0.0);
}

TEST(LightPropagation, blockersKeepLightOutOfTheDarkRoom) {
    const MeasuredRoom room("two_rooms", 300, 1);
    const auto inTheDark = [](const ReferencePoint& p) { return p.position.x > 6.0f; };
    const LightPropagationSettings open{.resolution = 16, .iterations = 24, .blocking = 0.0f, .damped = false};
    LightPropagationSettings blocked = open;
    blocked.blocking = 1.0f;
    EXPECT_LT(meanWhere(room, lightOf(room, blocked), inTheDark), 0.5 * meanWhere(room, lightOf(room, open), inTheDark));
}

TEST(LightPropagation, dampingTakesTheLightOfItsOwnSurfaceAway) {
    const MeasuredRoom room("cornell", 600, 1);
    // The tall block's top, right under the lamp: nothing but itself shines there.
    const auto underTheLamp = [](const ReferencePoint& p) { return p.normal.y > 0.9f && p.position.y > 0.32f; };
    LightPropagationSettings settings{.resolution = 8, .iterations = 16};
    const double damped = meanWhere(room, lightOf(room, settings), underTheLamp);
    settings.damped = false;
    EXPECT_LT(damped, 0.7 * meanWhere(room, lightOf(room, settings), underTheLamp));
}

TEST(LightPropagation, lightGrowsWithTheLamp) {
    MeasuredRoom dim("cornell", 200, 1);
    Scene bright = dim.scene;
    bright.lights[0].light.intensity *= 8.0f;
    const EmbreeScene embree(bright);
    const auto method = makeLightPropagation({.resolution = 8, .iterations = 8});
    method->prepare({embree, dim.parallelFor}, dim.points);
    const auto weak = lightOf(dim, {.resolution = 8, .iterations = 8}), strong = lightAfter(*method, dim, 1, 2, 1);
    for (std::size_t i = 0; i < weak.size(); ++i) EXPECT_NEAR(strong[i].y, 8.0f * weak[i].y, 1e-3f * strong[i].y + 1e-6f) << i;
}

TEST(LightPropagation, lightFollowsFromTheSeed) {
    expectLightFollowsFromTheSeed([] { return makeLightPropagation({.resolution = 8, .iterations = 8}); }, 1);
}

TEST(LightPropagation, forgetsOnRestart) {
    const MeasuredRoom room("cornell", 50, 1);
    const auto method = makeLightPropagation({.resolution = 8, .iterations = 4});
    method->prepare(room.world(), room.points);
    lightAfter(*method, room, 1, 2, 1);
    expectNothingAfterRestart(*method, room);
}

}  // namespace
}  // namespace clv::test
