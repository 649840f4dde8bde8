// Path tracing a pixel: unbiased, stratified, and as many rays as it says.
#include <gtest/gtest.h>

#include "baselines/method_run.h"
#include "benchmarks/baselines/path_tracing.h"
#include "furnace/surface_points.h"
#include "support/z_test.h"

namespace clv::test {
namespace {

TEST(PathTracing, whiteSphereReadsItsClosedForm) {
    MeasuredRoom room("white_sphere");
    room.points = surfacePoints(room.scene, 200, 3);
    const auto method = makePathTracing();
    method->prepare(room.world(), room.points);
    // Every facet sends the same light back to the lamp's side, up to how far facets lie off the sphere.
    const double expected = 0.8 * 4.0 * M_PI / surfaceArea(room.scene);
    for (const glm::vec3& e : lightAfter(*method, room, 1, 1, 64 * room.points.size())) EXPECT_NEAR(e.x / expected, 1.0, 4e-3);
}

TEST(PathTracing, meanOverTheFurnacesWallsIsTheReflectedFlux) {
    MeasuredRoom room("furnace_box");
    room.points = surfacePoints(room.scene, 400, 5);
    const auto method = makePathTracing();
    method->prepare(room.world(), room.points);
    MeanOf mean;
    for (const glm::vec3& e : lightAfter(*method, room, 1, 4, 64 * room.points.size())) mean.add(e.x);
    ZTest test;
    test.add("furnace_box", mean, 0.5 * 4.0 * M_PI / surfaceArea(room.scene));
    EXPECT_TRUE(test.agrees());
}

TEST(PathTracing, agreesWithTheReferenceAtEveryPoint) {
    const MeasuredRoom room("cornell", 60, 16384);
    const auto method = makePathTracing();
    method->prepare(room.world(), room.points);
    constexpr std::uint32_t kSeeds = 16;
    std::vector<MeanOf> mean(room.points.size());
    for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
        const std::vector<glm::vec3> light = lightAfter(*method, room, seed, 2, 128 * room.points.size());
        for (std::size_t i = 0; i < light.size(); ++i) mean[i].add(light[i].y);
    }
    ZTest test;
    for (std::size_t i = 0; i < mean.size(); ++i) {
        const double both = std::hypot(mean[i].standardError(), double(room.truth[i].standardError.y));
        test.add("point " + std::to_string(i), mean[i].mean(), room.truth[i].irradiance.y, both, kSeeds - 1.0);
    }
    EXPECT_TRUE(test.agrees());
}

TEST(PathTracing, framesStratifyEachOther) {
    const MeasuredRoom room("cornell", 60, 65536);
    const std::vector<glm::vec3> truth = room.trueIrradiance();
    const auto method = makePathTracing();
    method->prepare(room.world(), room.points);
    const double few = relativeErrors(lightAfter(*method, room, 1, 1, 16 * room.points.size()), truth).rmse;
    const double many = relativeErrors(lightAfter(*method, room, 1, 64, 16 * room.points.size()), truth).rmse;
    // Independent samples would leave an eighth.
    EXPECT_LT(many, few / 12.0);
}

TEST(PathTracing, countsShadowRaysToo) {
    MeasuredRoom room("white_sphere");
    room.points = surfacePoints(room.scene, 50, 3);
    const auto method = makePathTracing();
    method->prepare(room.world(), room.points);
    lightAfter(*method, room, 1, 3, 10 * room.points.size());
    EXPECT_EQ(method->raysTraced(), 2u * 3u * 10u * room.points.size());
    expectNothingAfterRestart(*method, room);
}

TEST(PathTracing, lightFollowsFromTheSeed) {
    expectLightFollowsFromTheSeed(makePathTracing, 37 * 70);
}

}  // namespace
}  // namespace clv::test
