// The thesis' rule: its one scale fits, its error stops falling, and its blend forgets at a fixed rate.
#include <gtest/gtest.h>

#include "baselines/method_run.h"
#include "benchmarks/baselines/thesis.h"
#include "furnace/surface_points.h"

namespace clv::test {
namespace {

TEST(Thesis, whiteSphereHasItsMeanByTheFittedScale) {
    MeasuredRoom room("white_sphere");
    room.points = surfacePoints(room.scene, 300, 3);
    const auto method = makeThesis({.resolution = 16});
    method->prepare(room.world(), room.points);
    const std::vector<glm::vec3> truth(room.points.size(), glm::vec3(0.8 * 4.0 * M_PI / surfaceArea(room.scene)));
    const RelativeErrors errors = relativeErrors(lightAfter(*method, room, 1, 1, 1 << 20), truth);
    // The least squared error leaves a bias of minus the squared error; what varies is how much of a cell lies in front of the wall.
    EXPECT_LT(errors.rmse, 0.3);
    EXPECT_NEAR(errors.bias, -errors.rmse * errors.rmse, 0.02);
}

TEST(Thesis, comesAsNearAsItsScaleAllows) {
    const MeasuredRoom room("cornell", 400, 2048);
    const auto method = makeThesis({.resolution = 32, .gridShift = glm::vec3(0.13f, 0.57f, 0.31f), .blend = 0.2f});
    method->prepare(room.world(), room.points);
    const std::vector<glm::vec3> truth = room.trueIrradiance();
    const double much = relativeErrors(lightAfter(*method, room, 1, 4, 256 << 10), truth).rmse;
    EXPECT_LT(much, 0.2);
    // More rays do not help: lengths, open volumes and what n^2 reads on oblique walls are left out.
    EXPECT_GT(relativeErrors(lightAfter(*method, room, 1, 4, 1 << 20), truth).rmse, 0.9 * much);
}

TEST(Thesis, lightGrowsWithTheLamp) {
    MeasuredRoom dim("cornell", 200, 1);
    Scene bright = dim.scene;
    bright.lights[0].light.intensity *= 8.0f;
    const EmbreeScene embree(bright);
    const auto a = makeThesis({.resolution = 12}), b = makeThesis({.resolution = 12});
    a->prepare(dim.world(), dim.points);
    b->prepare({embree, dim.parallelFor}, dim.points);
    const auto weak = lightAfter(*a, dim, 3, 1, 32 << 10), strong = lightAfter(*b, dim, 3, 1, 32 << 10);
    for (std::size_t i = 0; i < weak.size(); ++i) EXPECT_NEAR(strong[i].y, 8.0f * weak[i].y, 1e-3f * strong[i].y) << i;
}

TEST(Thesis, aSlowerBlendIsLessNoisyAndNoneGetsRidOfNoise) {
    const MeasuredRoom room("cornell", 200, 1);
    // Noise: how far runs with different seeds lie apart.
    const auto noise = [&](float blend, int frames) {
        const auto method = makeThesis({.resolution = 12, .blend = blend});
        method->prepare(room.world(), room.points);
        return relativeErrors(lightAfter(*method, room, 1, frames, 8 << 10), lightAfter(*method, room, 2, frames, 8 << 10)).rmse;
    };
    // Independent frames leave sqrt(blend / (2 - blend)) of a frame's noise: 0.58 and 0.16.
    const double fast = noise(0.5f, 40), slow = noise(0.05f, 40);
    EXPECT_GT(fast, 2.0 * slow);
    EXPECT_GT(noise(0.5f, 80), 0.7 * fast);
}

TEST(Thesis, lightFollowsFromTheSeed) {
    expectLightFollowsFromTheSeed([] { return makeThesis({.resolution = 10}); }, 8 << 10);
}

TEST(Thesis, forgetsOnRestart) {
    const MeasuredRoom room("cornell", 50, 1);
    const auto method = makeThesis({.resolution = 8});
    method->prepare(room.world(), room.points);
    lightAfter(*method, room, 1, 2, 8 << 10);
    EXPECT_EQ(method->raysTraced(), 16u << 10);
    expectNothingAfterRestart(*method, room);
}

}  // namespace
}  // namespace clv::test
