// What two estimates say about the error of their mean.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "bindings/cli/noise.h"
#include "bindings/cli/pipeline.h"
#include "bindings/cli/stress/whole_run.h"
#include "bindings/embree/task_pool.h"
#include "bindings/scene/builtin_scenes.h"

namespace clv::test {
namespace {

TEST(Noise, isTheStandardErrorOfTheMeanOverTheMean) {
    std::mt19937 random(1);
    std::normal_distribution<float> normal;
    for (const float sigma : {0.01f, 0.1f, 0.5f}) {  // of each estimate; their mean has 1 / sqrt(2) of it
        std::vector<glm::vec3> a, b;
        for (int i = 0; i < 20000; ++i) {
            const glm::vec3 light(1.0f, 2.0f, 3.0f);
            a.push_back(light + sigma * glm::vec3(normal(random), normal(random), normal(random)));
            b.push_back(light + sigma * glm::vec3(normal(random), normal(random), normal(random)));
        }
        EXPECT_NEAR(noiseOf(a, b).ofMean / (double(sigma) / std::sqrt(2.0) / 2.0), 1.0, 0.02) << sigma;
    }
}

TEST(Noise, countsDimPointsByTheirOwnLight) {
    std::vector<glm::vec3> a(100, glm::vec3(1.0f)), b = a;
    EXPECT_EQ(noiseOf(a, b).noisy, 0.0);
    for (int i = 0; i < 20; ++i) a[std::size_t(i)] = glm::vec3(0.2f), b[std::size_t(i)] = glm::vec3(0.05f);
    EXPECT_NEAR(noiseOf(a, b).noisy, 0.2, 1e-12);
    EXPECT_LT(noiseOf(a, b).ofMean, 0.05);
    // Below a twentieth of the mean it does not matter.
    for (int i = 0; i < 20; ++i) a[std::size_t(i)] = glm::vec3(0.01f), b[std::size_t(i)] = glm::vec3(0.001f);
    EXPECT_EQ(noiseOf(a, b).noisy, 0.0);
    EXPECT_EQ(noiseOf(std::vector<glm::vec3>(5), std::vector<glm::vec3>(5)).ofMean, 0.0);
    EXPECT_EQ(noiseOf(std::vector<glm::vec3>(5), std::vector<glm::vec3>(5)).dark, 1.0);
    EXPECT_EQ(noiseOf({}, {}).dark, 0.0);
}

// A closed room, lit through a hole of 2 cm from the one beside it: by few rays, or none.
Scene behindAHole() {
    SceneBuilder builder("hole");
    const std::uint32_t white = builder.addMaterial({"white", glm::vec3(0.8f), -1});
    builder.beginNode("rooms");
    const BlockGrid grid{{-2.0, -1.0, -0.01, 0.01, 1.0, 2.0}, {-1.0, -0.01, 0.01, 1.0}, {-1.0, -0.01, 0.01, 1.0},
                         [](const glm::ivec3& c) { return (c.x == 2) && !(c.y == 1 && c.z == 1); }, true};
    addBlocks(builder, grid, [=](const glm::ivec3&, const glm::ivec3&) { return white; });
    builder.addLight("lamp", makePointLight(glm::vec3(1.0f)), {-1.2, 0.1, -0.3});
    return std::move(builder).finish("hole");
}

TEST(Noise, isSaidWhereFewRaysCome) {
    const Scene scene = behindAHole();
    std::vector<ReferencePoint> points;
    for (int i = 0; i < 64; ++i) points.push_back({glm::vec3(1.99f, -0.9f + 0.225f * float(i % 8), -0.9f + 0.225f * float(i / 8)) - glm::vec3(scene.anchor), glm::vec3(-1.0f, 0.0f, 0.0f)});
    for (const bool allBounces : {false, true}) {
        LightOptions options;
        options.rays = 64 << 10, options.allBounces = allBounces;
        std::vector<glm::vec3> irradiance(points.size());
        const PipelineReport report = lightPoints(scene, options, 1, tbbParallelFor(2), points, irradiance);
        ASSERT_TRUE(report.noise);
        EXPECT_TRUE(report.noise->ofMean > 0.2 || report.noise->dark == 1.0);
        EXPECT_TRUE(std::ranges::any_of(report.warnings, [](const std::string& warning) {
            return warning.find("is noisy") != std::string::npos || warning.find("got no light") != std::string::npos;
        })) << report.noise->ofMean << ' ' << report.noise->noisy << ' ' << report.noise->dark;
    }
}

// From seed to seed the light differs by as much as one run says of itself.
TEST(Noise, isWhatSeedsDifferBy) {
    const Scene scene = makeBuiltinScene("two_rooms");
    std::vector<ReferencePoint> points;
    for (int i = 0; i < 200; ++i) points.push_back({glm::vec3(0.3f + 0.01f * float(i), 0.0f, 0.5f + 0.005f * float(i)) - glm::vec3(scene.anchor), glm::vec3(0.0f, 1.0f, 0.0f)});
    for (const bool allBounces : {false, true}) {
        LightOptions options;
        options.rays = 128 << 10, options.allBounces = allBounces;
        constexpr int kSeeds = 12;
        std::vector<std::vector<glm::vec3>> runs;
        double said = 0.0, mean = 0.0, variance = 0.0;
        for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
            auto& run = runs.emplace_back(points.size());
            const PipelineReport report = lightPoints(scene, options, seed, tbbParallelFor(2), points, run);
            said += std::pow(report.noise.value().ofMean, 2.0) / kSeeds;
        }
        for (std::size_t i = 0; i < points.size(); ++i) {
            glm::dvec3 sum(0.0), squares(0.0);
            for (const auto& run : runs) sum += glm::dvec3(run[i]) / double(kSeeds);
            for (const auto& run : runs) squares += (glm::dvec3(run[i]) - sum) * (glm::dvec3(run[i]) - sum) / double(kSeeds - 1);
            mean += (sum.x + sum.y + sum.z) / 3.0 / double(points.size()), variance += (squares.x + squares.y + squares.z) / 3.0 / double(points.size());
        }
        const double differ = std::sqrt(variance) / mean;
        EXPECT_GT(std::sqrt(said), 0.7 * differ) << allBounces;
        EXPECT_LT(std::sqrt(said), 2.0 * differ) << allBounces;
    }
}

}  // namespace
}  // namespace clv::test
