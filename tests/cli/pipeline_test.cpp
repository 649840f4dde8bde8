// Light through the volume against what is known: closed forms, path-traced truth, and what the plan promises to leave out.
#include <gtest/gtest.h>

#include "benchmarks/report/metrics.h"
#include "bindings/cli/pipeline.h"
#include "bindings/cli/reference_run.h"
#include "bindings/cli/scene_facts.h"
#include "bindings/embree/task_pool.h"
#include "bindings/embree/visible_points.h"
#include "furnace/surface_points.h"

namespace clv::test {
namespace pipeline_test {

LightOptions optionsFor(bool allBounces, std::uint64_t rays) {
    LightOptions options;
    options.allBounces = allBounces;
    options.rays = rays;
    return options;
}

struct Light {
    std::vector<glm::vec3> irradiance;
    PipelineReport report;
};

Light lightOf(const Scene& scene, const LightOptions& options, std::span<const ReferencePoint> points, std::uint32_t seed = 1) {
    Light light;
    light.irradiance.resize(points.size());
    light.report = lightPoints(scene, options, seed, tbbParallelFor(2), points, light.irradiance);
    return light;
}

constexpr double kLampFlux = 4.0 * M_PI;  // W, a channel: the lamps of both furnaces

TEST(Furnaces, oneBounceIsTheAlbedoTimesTheFluxOverTheArea) {
    const Scene sphere = makeBuiltinScene("white_sphere"), box = makeBuiltinScene("furnace_box");
    const LightOptions options = optionsFor(false, 2u << 20);
    // The cupboard and the plank of the box are coarse to the coarsest levels, whose bias the library may choose over noise.
    LightOptions fine = options;
    fine.resolution = 32;
    EXPECT_NEAR(meanIrradiance(lightOf(sphere, options, surfacePoints(sphere, 4096, 3)).irradiance) / 0.8, 1.0, 1e-3);
    EXPECT_NEAR(meanIrradiance(lightOf(box, fine, surfacePoints(box, 8192, 3)).irradiance) / (0.5 * kLampFlux / surfaceArea(box)), 1.0, 3e-3);
}

TEST(Furnaces, allBouncesAreAGeometricSeries) {
    const Scene sphere = makeBuiltinScene("white_sphere"), box = makeBuiltinScene("furnace_box");
    const LightOptions options = optionsFor(true, 2u << 20);
    // The cupboard and the plank of the box are coarse to the coarsest levels, whose bias the library may choose over noise.
    LightOptions fine = options;
    fine.resolution = 32;
    EXPECT_NEAR(meanIrradiance(lightOf(sphere, options, surfacePoints(sphere, 4096, 3)).irradiance) / 4.0, 1.0, 1e-3);
    EXPECT_NEAR(meanIrradiance(lightOf(box, fine, surfacePoints(box, 8192, 3)).irradiance) / (kLampFlux / surfaceArea(box)), 1.0, 3e-3);
}

// Surface points that the scene's cameras see.
std::vector<ReferencePoint> seenPoints(const Scene& scene, std::size_t count) {
    std::vector<ReferencePoint> points;
    for (const ClvReceiver& r : visiblePoints(EmbreeScene(scene), count, 7)) points.push_back({r.position, r.normal});
    return points;
}

std::vector<glm::vec3> truthAt(const Scene& scene, std::span<const ReferencePoint> points, bool allBounces, std::uint64_t samples) {
    return runReference(EmbreeScene(scene), points, {.samples = samples}, allBounces, 5, tbbParallelFor(2)).irradiance();
}

TEST(Truth, cornellIsMetForOneBounceAndAll) {
    const Scene scene = makeBuiltinScene("cornell");
    const auto points = seenPoints(scene, 1000);
    for (bool all : {false, true}) {
        const Light light = lightOf(scene, optionsFor(all, 1u << 20), points);
        const ErrorSummary errors = summarizeErrors(light.irradiance, truthAt(scene, points, all, 4096));
        EXPECT_LT(errors.relativeRmse, 0.06) << (all ? "all" : "one");
        EXPECT_LT(std::abs(errors.bias), 0.01) << (all ? "all" : "one");
    }
}

TEST(Truth, theDarkRoomStaysDarkWhereverTheGridLies) {
    const Scene scene = makeBuiltinScene("two_rooms");
    std::vector<ReferencePoint> dark;
    for (const ReferencePoint& p : surfacePoints(scene, 20000, 3)) {
        const glm::dvec3 world = glm::dvec3(p.position) + scene.anchor;
        const bool inDarkRoom = world.x > 5.3 && world.x < 10.15 && world.y > 0.03 && world.y < 2.96 && world.z > -2.5 && world.z < 2.53;
        if (inDarkRoom) dark.push_back(p);
    }
    const std::vector<glm::vec3> truth = truthAt(scene, dark, false, 1024);
    for (const auto& shift : {std::array{0.0, 0.0, 0.0}, {0.5, 0.5, 0.5}, {0.25, 0.75, 0.375}, {0.8, 0.1, 0.6}}) {
        LightOptions options = optionsFor(false, 2u << 20);
        options.resolution = 32;
        options.cellShift = shift;
        const Light light = lightOf(scene, options, dark);
        const double ratio = leak(light.irradiance, truth, {});
        EXPECT_LT(ratio, 1.1) << shift[0];
        EXPECT_GT(ratio, 0.9) << shift[0];
        }
}

}  // namespace pipeline_test
}  // namespace clv::test
