#include "bindings/embree/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "bindings/embree/task_pool.h"
#include "embree/small_scenes.h"

namespace clv::test {
namespace {

// A floor over [-5, 5]^2 at y = 0 and a roof over the half x > 0 at y = 3.
SmallScene floorAndRoof() {
    SmallScene scene;
    const std::uint32_t grey = scene.material(glm::vec3(0.5f));
    scene.rectangle({-5, 0, -5}, {0, 0, 10}, {10, 0, 0}, grey);
    scene.rectangle({0, 3, -5}, {5, 0, 0}, {0, 0, 10}, grey);
    return scene;
}

const glm::vec3 kUp(0, 1, 0);

TEST(DirectIrradiance, pointLightFallsWithTheSquareAndTheCosine) {
    SmallScene small = floorAndRoof();
    small.light(makePointLight(glm::vec3(1.0f, 2.0f, 4.0f)), {-3, 2, 0});
    const Scene scene = small.finish();
    const EmbreeScene embree(scene);
    // From (-1, 0, 1): distance^2 = 4 + 4 + 1 = 9, cosine 2/3.
    const glm::vec3 irradiance = directIrradiance(embree, glm::vec3(-1, 0, 1), kUp);
    EXPECT_NEAR(irradiance.x, 2.0 / 27.0, 1e-6);
    EXPECT_NEAR(irradiance.z, 8.0 / 27.0, 1e-6);
}

TEST(DirectIrradiance, directionalLightFallsWithTheCosineAndStopsAtTheRoof) {
    SmallScene small = floorAndRoof();
    small.light(makeDirectionalLight(glm::vec3(-3, -4, 0), glm::vec3(10.0f)));
    const Scene scene = small.finish();
    const EmbreeScene embree(scene);
    EXPECT_NEAR(directIrradiance(embree, glm::vec3(-4, 0, 0), kUp).x, 8.0, 1e-5);
    // The roof's edge throws its shadow to x = -9/4.
    EXPECT_NEAR(directIrradiance(embree, glm::vec3(-2.251f, 0, 0), kUp).x, 8.0, 1e-5);
    EXPECT_EQ(directIrradiance(embree, glm::vec3(-2.249f, 0, 0), kUp).x, 0.0f);
}

TEST(DirectIrradiance, spotLightFallsOffBetweenItsCones) {
    SmallScene small = floorAndRoof();
    small.light(makeSpotLight(glm::vec3(0, -1, 0), glm::vec3(1.0f), 0.3f, 0.8f), {-3, 2, 0});
    const Scene scene = small.finish();
    const EmbreeScene embree(scene);
    const auto at = [&](double angle) { return directIrradiance(embree, glm::vec3(-3.0, 0, 2.0 * std::tan(angle)), kUp).x; };
    const auto unshadowed = [](double angle) { return std::pow(std::cos(angle), 3) / 4.0; };
    EXPECT_NEAR(at(0.2), unshadowed(0.2), 1e-6);
    const double ramp = (std::cos(0.6) - std::cos(0.8)) / (std::cos(0.3) - std::cos(0.8));
    EXPECT_NEAR(at(0.6), ramp * ramp * unshadowed(0.6), 1e-6);
    EXPECT_EQ(at(0.81), 0.0f);
}

TEST(DirectIrradiance, isTakenOnTheSideOfTheNormal) {
    SmallScene small = floorAndRoof();
    small.light(makePointLight(glm::vec3(1.0f)), {-3, 2, 0});
    const Scene scene = small.finish();
    const EmbreeScene embree(scene);
    EXPECT_EQ(directIrradiance(embree, glm::vec3(-3, 0, 0), -kUp), glm::vec3(0.0f));
}

TEST(DirectIrradiance, lightsAddUp) {
    SmallScene small = floorAndRoof();
    small.light(makePointLight(glm::vec3(1.0f)), {-3, 2, 0});
    small.light(makePointLight(glm::vec3(2.0f)), {-3, 2, 0});
    const Scene scene = small.finish();
    EXPECT_NEAR(directIrradiance(EmbreeScene(scene), glm::vec3(-3, 0, 0), kUp).x, 3.0 / 4.0, 1e-6);
}

TEST(DirectIrradiance, pointInTheLampItselfIsFinite) {
    SmallScene small = floorAndRoof();
    small.light(makePointLight(glm::vec3(1.0f)), {-3, 0, 0});
    const Scene scene = small.finish();
    EXPECT_TRUE(std::isfinite(directIrradiance(EmbreeScene(scene), scene.lights[0].light.position, kUp).x));
}

TEST(DirectIrradiance, surfaceThatALampLiesOnDoesNotShadowIt) {
    SmallScene small = floorAndRoof();
    small.light(makePointLight(glm::vec3(1.0f)), {1.25, 3, 0.5});
    const Scene scene = small.finish();
    const EmbreeScene embree(scene);
    for (int k = 0; k < 100; ++k) {
        const glm::vec3 at(0.09f * float(k) - 4.0f, 0.0f, 0.04f * float(k) - 2.0f);
        const double height = 3.0, square = height * height + std::pow(at.x - 1.25, 2) + std::pow(at.z - 0.5, 2);
        EXPECT_NEAR(directIrradiance(embree, at, kUp).x, height / std::pow(square, 1.5), 1e-6) << k;
    }
}

std::vector<ReferencePoint> pointsInBox(int count) {
    std::vector<ReferencePoint> points;
    for (uint i = 0; i < uint(count); ++i) points.push_back({0.2f * randomDirection(61, i), randomDirection(62, i)});
    return points;
}

std::vector<ReferenceResult> referenceOf(const EmbreeScene& scene, const std::vector<ReferencePoint>& points, const ReferenceOptions& options,
                                         const ParallelFor& parallelFor = serialFor()) {
    std::vector<ReferenceResult> results(points.size());
    referenceIrradiance(scene, points, options, parallelFor, results);
    return results;
}

TEST(ReferenceIrradiance, threadsDoNotChangeABit) {
    const Scene scene = makeBuiltinScene("furnace_box");
    const EmbreeScene embree(scene);
    const std::vector<ReferencePoint> points = pointsInBox(20);
    const ReferenceOptions options{.allBounces = true, .samplesPerPoint = 700, .seed = 3};
    const ParallelFor backwards = [](std::size_t count, const std::function<void(std::size_t)>& body) {
        while (count > 0) body(--count);
    };
    const std::vector<ReferenceResult> expected = referenceOf(embree, points, options);
    for (const ParallelFor& parallelFor : {tbbParallelFor(2), backwards}) {
        const std::vector<ReferenceResult> results = referenceOf(embree, points, options, parallelFor);
        EXPECT_EQ(std::memcmp(results.data(), expected.data(), results.size() * sizeof(ReferenceResult)), 0);
    }
}

TEST(ReferenceIrradiance, seedsAndPointsDrawTheirOwnSamples) {
    const Scene scene = makeBuiltinScene("furnace_box");
    const EmbreeScene embree(scene);
    const std::vector<ReferencePoint> points(2, pointsInBox(1)[0]);
    const std::vector<ReferenceResult> first = referenceOf(embree, points, {.samplesPerPoint = 64, .seed = 1});
    const std::vector<ReferenceResult> second = referenceOf(embree, points, {.samplesPerPoint = 64, .seed = 2});
    EXPECT_NE(first[0].irradiance, first[1].irradiance);
    EXPECT_NE(first[0].irradiance, second[0].irradiance);
}

TEST(ReferenceIrradiance, singleSampleKnowsNothingOfItsError) {
    const Scene scene = makeBuiltinScene("furnace_box");
    const EmbreeScene embree(scene);
    const std::vector<ReferenceResult> results = referenceOf(embree, pointsInBox(1), {.samplesPerPoint = 1});
    EXPECT_TRUE(std::isfinite(results[0].irradiance.x));
    EXPECT_TRUE(std::isinf(results[0].standardError.x));
}

TEST(ReferenceIrradiance, sceneWithoutLightIsDark) {
    Scene scene = makeBuiltinScene("furnace_box");
    scene.lights.clear();
    const EmbreeScene embree(scene);
    const std::vector<ReferenceResult> results = referenceOf(embree, pointsInBox(3), {.allBounces = true, .samplesPerPoint = 128});
    for (const ReferenceResult& result : results) {
        EXPECT_EQ(result.irradiance, glm::vec3(0.0f));
        EXPECT_EQ(result.standardError, glm::vec3(0.0f));
    }
}

TEST(ReferenceIrradiance, pathsEndInAClosedSceneThatAbsorbsNothing) {
    Scene scene = makeBuiltinScene("furnace_box");
    for (Material& material : scene.materials) material.albedo = glm::vec3(1.0f);
    const EmbreeScene embree(scene);
    const std::vector<ReferenceResult> results = referenceOf(embree, pointsInBox(1), {.allBounces = true, .samplesPerPoint = 256});
    EXPECT_TRUE(std::isfinite(results[0].irradiance.x));
    // The truth is infinite; a thousand bounces bring each about the flux of the lamp over the walls.
    EXPECT_GT(results[0].irradiance.x, 100.0f);
    EXPECT_GT(results[0].standardError.x, 0.01f * results[0].irradiance.x);
}

}  // namespace
}  // namespace clv::test
