// The truth against scenes whose answer is known in closed form: the path tracer judges everything else, so it is judged here.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "bindings/embree/task_pool.h"
#include "embree/small_scenes.h"
#include "furnace/surface_points.h"
#include "support/chi_square.h"
#include "support/z_test.h"

namespace clv::test {
namespace {

std::vector<ReferenceResult> referenceOf(const Scene& scene, const std::vector<ReferencePoint>& points, const ReferenceOptions& options) {
    const EmbreeScene embree(scene);
    std::vector<ReferenceResult> results(points.size());
    referenceIrradiance(embree, points, options, tbbParallelFor(), results);
    return results;
}

Scene furnaceOf(const std::string& name, const glm::vec3& albedo) {
    Scene scene = makeBuiltinScene(name);
    for (Material& material : scene.materials) material.albedo = albedo;
    return scene;
}

// Flux of a furnace's lamp, W, over its walls, m^2.
double fluxOverArea(const Scene& scene) { return 4.0 * M_PI * scene.lights[0].light.intensity.x / surfaceArea(scene); }

// The mean over points that are uniform by area. Its standard error holds both the noise of the points and their spread.
void addMeanOverSurface(ZTest& test, const std::string& what, const Scene& scene, const ReferenceOptions& options, const glm::dvec3& expected) {
    MeanOf channel[3];
    for (const ReferenceResult& result : referenceOf(scene, surfacePoints(scene, 400, options.seed), options)) {
        for (int c = 0; c < 3; ++c) channel[c].add(result.irradiance[c]);
    }
    for (int c = 0; c < 3; ++c) test.add(what + " channel " + std::to_string(c), channel[c], expected[c]);
}

class Furnace : public testing::TestWithParam<const char*> {};

TEST_P(Furnace, oneBounceIsTheReflectedFluxOverTheArea) {
    ZTest test;
    for (float rho : {0.1f, 0.5f, 0.8f, 0.95f, 1.0f}) {
        const Scene scene = furnaceOf(GetParam(), glm::vec3(rho));
        addMeanOverSurface(test, "rho " + std::to_string(rho), scene, {.samplesPerPoint = 256, .seed = 7}, glm::dvec3(rho * fluxOverArea(scene)));
    }
    EXPECT_TRUE(test.agrees());
}

TEST_P(Furnace, allBouncesAreTheGeometricSeries) {
    ZTest test;
    for (float rho : {0.1f, 0.5f, 0.8f, 0.95f}) {
        const Scene scene = furnaceOf(GetParam(), glm::vec3(rho));
        addMeanOverSurface(test, "rho " + std::to_string(rho), scene, {.allBounces = true, .samplesPerPoint = 256, .seed = 8},
                           glm::dvec3(fluxOverArea(scene) * rho / (1.0 - rho)));
    }
    EXPECT_TRUE(test.agrees());
}

TEST_P(Furnace, everyChannelHasItsOwnSeries) {
    const glm::vec3 rho(0.9f, 0.4f, 0.0f);
    const Scene scene = furnaceOf(GetParam(), rho);
    const glm::dvec3 expected = fluxOverArea(scene) * glm::dvec3(rho) / (1.0 - glm::dvec3(rho));
    const std::vector<ReferenceResult> results =
        referenceOf(scene, surfacePoints(scene, 400, 9), {.allBounces = true, .samplesPerPoint = 256, .seed = 9});
    MeanOf red, green;
    for (const ReferenceResult& result : results) {
        red.add(result.irradiance.x);
        green.add(result.irradiance.y);
        EXPECT_EQ(result.irradiance.z, 0.0f);
    }
    ZTest test;
    test.add("red", red, expected.x);
    test.add("green", green, expected.y);
    EXPECT_TRUE(test.agrees());
}

INSTANTIATE_TEST_SUITE_P(Scenes, Furnace, testing::Values("white_sphere", "furnace_box"), [](const auto& info) { return std::string(info.param); });

TEST(SphereFurnace, everyPointSeesTheSameWhereverTheLampIs) {
    Scene scene = furnaceOf("white_sphere", glm::vec3(0.8f));
    scene.lights[0].light.position += glm::vec3(0.2f, -0.3f, 0.4f);
    const double expected = 0.8 * fluxOverArea(scene);
    // At its centroid a facet lies like the sphere up to about the square of its edge, 0.038 rad for 20,480 facets; twice that
    // where the lamp is near.
    const double facetError = 2.0 * 0.038 * 0.038;
    std::vector<ReferencePoint> points;
    for (std::size_t i = 0; i < scene.triangles.size(); i += 200) {
        const glm::uvec3& t = scene.triangles[i];
        const glm::vec3 centroid = (scene.positions[t.x] + scene.positions[t.y] + scene.positions[t.z]) / 3.0f;
        points.push_back({centroid, glm::normalize(glm::cross(scene.positions[t.y] - scene.positions[t.x], scene.positions[t.z] - scene.positions[t.x]))});
    }
    for (const ReferenceResult& result : referenceOf(scene, points, {.samplesPerPoint = 65536, .seed = 10})) {
        EXPECT_NEAR(result.irradiance.x / expected, 1.0, facetError + 5.0 * result.standardError.x / expected);
    }
}

// A floor over [0, a] x [0, b] at y = 0 in full sun; receivers above its corner hang free.
struct SunlitFloor {
    static constexpr double a = 3.0, b = 2.0, rho = 0.6, sun = 5.0;
    Scene scene;
    SunlitFloor() {
        SmallScene small;
        small.rectangle({0, 0, 0}, {0, 0, b}, {a, 0, 0}, small.material(glm::vec3(rho)));
        small.light(makeDirectionalLight(glm::vec3(0.2f, -1.0f, 0.3f), glm::vec3(sun)));
        scene = small.finish();
    }
    double exitance() const { return rho * sun / glm::length(glm::dvec3(0.2, -1.0, 0.3)); }
};

// Form factor from an element to the rectangle [0, x] x [0, y] that it faces, in parallel, a unit away from the corner (Howell C-11).
double parallelFormFactor(double x, double y) {
    const double p = std::sqrt(1.0 + x * x), q = std::sqrt(1.0 + y * y);
    return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2.0 * M_PI);
}

// The same for an element whose normal lies along the rectangle's side `x` (Howell C-12, with the height 1 and the side y across).
double perpendicularFormFactor(double x, double y) {
    const double r = std::sqrt(1.0 + x * x);
    return (std::atan(y) - std::atan(y / r) / r) / (2.0 * M_PI);
}

TEST(FormFactors, floorLightsReceiversAboveItsCorner) {
    const SunlitFloor floor;
    const double h = 1.25;
    const std::vector<ReferencePoint> points{{glm::vec3(0, h, 0), glm::vec3(0, -1, 0)}, {glm::vec3(0, h, 0), glm::vec3(1, 0, 0)},
                                             {glm::vec3(0, h, 0), glm::vec3(0, 0, 1)}};
    const std::vector<ReferenceResult> results = referenceOf(floor.scene, points, {.samplesPerPoint = 262144});
    const double factors[] = {parallelFormFactor(floor.a / h, floor.b / h), perpendicularFormFactor(floor.a / h, floor.b / h),
                              perpendicularFormFactor(floor.b / h, floor.a / h)};
    ZTest test;
    for (int i = 0; i < 3; ++i) {
        test.add("normal " + std::to_string(i), results[i].irradiance.x, floor.exitance() * factors[i], results[i].standardError.x,
                 kReferenceBatches - 1.0);
    }
    EXPECT_TRUE(test.agrees());
}

TEST(FormFactors, normalsAwayFromTheFloorSeeNothing) {
    const SunlitFloor floor;
    const std::vector<ReferenceResult> results =
        referenceOf(floor.scene, {{glm::vec3(1, 1, 1), glm::vec3(0, 1, 0)}, {glm::vec3(1, 0, 1), glm::vec3(0, -1, 0)}}, {.allBounces = true});
    for (const ReferenceResult& result : results) EXPECT_EQ(result.irradiance, glm::vec3(0.0f));
}

TEST(FormFactors, wideFloorLightsWhatHangsAtTheLampsHeight) {
    // The floor's irradiance I h / (r^2 + h^2)^(3/2) is reflected with rho / pi and seen from the height z under both cosines
    // z^2 / (r^2 + z^2)^2. Over the endless floor, for z = h, the integral is 2 rho I / (5 h^2); beyond 20 h lies (1/20)^5 of it.
    constexpr double rho = 0.7, intensity = 3.0, h = 0.5, reach = 10.0;
    SmallScene small;
    small.rectangle({-reach, 0, -reach}, {0, 0, 2 * reach}, {2 * reach, 0, 0}, small.material(glm::vec3(rho)));
    // A black ceiling, which adds nothing to all bounces either.
    small.rectangle({-reach, 2 * h, -reach}, {2 * reach, 0, 0}, {0, 0, 2 * reach}, small.material(glm::vec3(0.0f)));
    small.light(makePointLight(glm::vec3(intensity)), {0.0, h, 0.0});
    const Scene scene = small.finish();
    const std::vector<ReferenceResult> results = referenceOf(scene, {{glm::vec3(0, h, 0), glm::vec3(0, -1, 0)}}, {.allBounces = true, .samplesPerPoint = 16384});
    ZTest test;
    test.add("above the floor", results[0].irradiance.x, 2.0 * rho * intensity / (5.0 * h * h), results[0].standardError.x, kReferenceBatches - 1.0);
    EXPECT_TRUE(test.agrees());
}

TEST(TwoSides, sheetIsLitAndReflectsOnBothSides) {
    // A sheet lit from below, its back face: only receivers below see it shine.
    SmallScene small;
    small.rectangle({0, 0, 0}, {0, 0, 2}, {3, 0, 0}, small.material(glm::vec3(0.6f)));
    small.light(makeDirectionalLight(glm::vec3(0, 1, 0), glm::vec3(5.0f)));
    const Scene scene = small.finish();
    const std::vector<ReferenceResult> results = referenceOf(
        scene, {{glm::vec3(0, -1, 0), glm::vec3(0, 1, 0)}, {glm::vec3(0, 1, 0), glm::vec3(0, -1, 0)}}, {.samplesPerPoint = 65536});
    ZTest test;
    test.add("below", results[0].irradiance.x, 0.6 * 5.0 * parallelFormFactor(3.0, 2.0), results[0].standardError.x, kReferenceBatches - 1.0);
    EXPECT_TRUE(test.agrees());
    EXPECT_EQ(results[1].irradiance, glm::vec3(0.0f));
}

TEST(StandardError, isHonest) {
    const SunlitFloor floor;
    const ReferencePoint point{glm::vec3(0, 1, 0), glm::vec3(0, -1, 0)};
    const double expected = floor.exitance() * parallelFormFactor(floor.a, floor.b);
    // All bounces and one, few samples a batch and many, and a number of samples that fills no packet.
    for (std::uint64_t samples : {64u, 1000u, 4096u}) {
        constexpr int kSeeds = 400;
        double squares = 0.0;
        for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
            const ReferenceResult result = referenceOf(floor.scene, {point}, {.samplesPerPoint = samples, .seed = seed})[0];
            const double z = normalFromStudent((result.irradiance.x - expected) / result.standardError.x, kReferenceBatches - 1.0);
            squares += z * z;
        }
        // The sum of squares of kSeeds standard normal deviates follows chi-square: neither tail may be reached.
        const double chance = chiSquareTail(squares, kSeeds);
        EXPECT_GT(chance, 1e-3) << samples;
        EXPECT_LT(chance, 1.0 - 1e-3) << samples;
    }
}

}  // namespace
}  // namespace clv::test
