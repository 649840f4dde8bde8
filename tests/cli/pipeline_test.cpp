// Light through the volume against what is known: closed forms, path-traced truth, and what the plan promises to leave out.
#include <gtest/gtest.h>

#include "benchmarks/report/metrics.h"
#include "bindings/cli/pipeline.h"
#include "bindings/cli/reference_run.h"
#include "bindings/cli/scene_facts.h"
#include "bindings/cli/stress/whole_run.h"
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

TEST(Furnaces, oneBounceIsTheAlbedoTimesTheFluxOverTheArea) {
    const Scene sphere = makeBuiltinScene("white_sphere"), box = makeBuiltinScene("furnace_box");
    const LightOptions options = optionsFor(false, 2u << 20);
    // The cupboard and the plank of the box are coarse to the coarsest levels, whose bias the library may choose over noise.
    LightOptions fine = options;
    fine.resolution = 32;
    EXPECT_NEAR(meanIrradiance(lightOf(sphere, options, surfacePoints(sphere, 4096, 3)).irradiance) / 0.8, 1.0, 1e-3);
    EXPECT_NEAR(meanIrradiance(lightOf(box, fine, surfacePoints(box, 8192, 3)).irradiance) / (0.5 * kLampPower / surfaceArea(box)), 1.0, 3e-3);
}

TEST(Furnaces, allBouncesAreAGeometricSeries) {
    const Scene sphere = makeBuiltinScene("white_sphere"), box = makeBuiltinScene("furnace_box");
    const LightOptions options = optionsFor(true, 2u << 20);
    // The cupboard and the plank of the box are coarse to the coarsest levels, whose bias the library may choose over noise.
    LightOptions fine = options;
    fine.resolution = 32;
    EXPECT_NEAR(meanIrradiance(lightOf(sphere, options, surfacePoints(sphere, 4096, 3)).irradiance) / 4.0, 1.0, 1e-3);
    EXPECT_NEAR(meanIrradiance(lightOf(box, fine, surfacePoints(box, 8192, 3)).irradiance) / (kLampPower / surfaceArea(box)), 1.0, 3e-3);
}

// Closed rooms of 2 m beside each other, walls of one albedo each, and a lamp in each.
Scene rooms(const std::vector<glm::vec3>& albedos, float lampOfTheSecond = 1.0f) {
    SceneBuilder builder("rooms");
    for (std::size_t k = 0; k < albedos.size(); ++k) {
        const std::uint32_t wall = builder.addMaterial({"wall", albedos[k], -1});
        builder.beginNode("room");
        const glm::dvec3 center(4.0 * double(k), 0.0, 0.0);
        addRoom(builder, wall, 1.0, center);
        builder.addLight("lamp " + std::to_string(k), makePointLight(glm::vec3(k == 0 ? 1.0f : lampOfTheSecond)), center + glm::dvec3(0.2, 0.1, -0.3));
    }
    return std::move(builder).finish("rooms");
}

// Of the room around x.
std::vector<ReferencePoint> wallsAround(double x) { return pointsOnWalls(1.0, {x, 0.0, 0.0}); }

TEST(Furnaces, everyChannelHasItsOwnSeries) {
    for (const glm::dvec3& albedo : {glm::dvec3(0.99, 0.9, 0.5), glm::dvec3(0.95, 0.93, 0.88), glm::dvec3(0.5, 0.99, 0.0)}) {
        const Scene scene = rooms({glm::vec3(albedo)});
        LightOptions options = optionsFor(true, 2u << 20);
        options.resolution = 16;
        const auto light = lightOf(scene, options, wallsAround(0.0));
        const glm::dvec3 exact = albedo / (1.0 - albedo) * kLampPower / 24.0;
        glm::dvec3 mean(0.0);
        for (const glm::vec3& e : light.irradiance) mean += glm::dvec3(e) / double(light.irradiance.size());
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], exact[c], 0.01 * exact[c]) << albedo[c];
        EXPECT_TRUE(light.report.warnings.empty());
    }
}

TEST(Furnaces, everyRoomHasItsOwnSeries) {
    const Scene scene = rooms({glm::vec3(0.99f), glm::vec3(0.9f)});
    LightOptions options = optionsFor(true, 4u << 20);
    options.resolution = 16;
    EXPECT_NEAR(meanIrradiance(lightOf(scene, options, wallsAround(0.0)).irradiance) / (99.0 * kLampPower / 24.0), 1.0, 0.03);
    EXPECT_NEAR(meanIrradiance(lightOf(scene, options, wallsAround(4.0)).irradiance) / (9.0 * kLampPower / 24.0), 1.0, 0.03);
}

TEST(Furnaces, aSmallRoomOnAWideGroundIsTheSameOnAllBackEnds) {
    SceneBuilder builder("room");
    const std::uint32_t white = builder.addMaterial({"white", glm::vec3(0.95f), -1});
    builder.beginNode("room");
    addRoom(builder, white);
    builder.beginNode("ground");
    builder.addQuad({-50, -2, 50}, {50, -2, 50}, {50, -2, -50}, {-50, -2, -50}, white);
    builder.addLight("lamp", makePointLight(glm::vec3(1.0f)), {0.2, 0.1, -0.3});
    const Scene scene = std::move(builder).finish("room");
    LightOptions options = optionsFor(true, 1u << 20);
    options.resolution = 64;
    const Light cpu = lightOf(scene, options, wallsAround(0.0));
    options.backend.choice = "vulkan";
    const Light gpu = lightOf(scene, options, wallsAround(0.0));
    EXPECT_GT(cpu.report.sweeps, 50u);
    EXPECT_NEAR(double(gpu.report.sweeps), double(cpu.report.sweeps), 0.1 * double(cpu.report.sweeps)) << "counts of rays follow from sums that differ in their last places";
    EXPECT_NEAR(meanIrradiance(gpu.irradiance) / meanIrradiance(cpu.irradiance), 1.0, 0.02);
}

bool isWarned(const Light& light, const std::string& words) {
    return std::ranges::any_of(light.report.warnings, [&](const std::string& warning) { return warning.find(words) != std::string::npos; });
}

TEST(Warnings, sayWhatIsDarkOrNotItsOwnLight) {
    const LightOptions options = optionsFor(false, 64u << 10);
    const Scene dim = rooms({glm::vec3(0.5f), glm::vec3(0.5f)}, 1e-6f), like = rooms({glm::vec3(0.5f), glm::vec3(0.5f)}, 0.5f);
    const auto inside = wallsAround(0.0);
    EXPECT_TRUE(isWarned(lightOf(dim, options, inside), "light \"lamp 1\" sends so little"));
    EXPECT_TRUE(lightOf(like, options, inside).report.warnings.empty());
    SceneBuilder builder("solid");
    builder.beginNode("box");
    addBox(builder, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, builder.addMaterial({"grey", glm::vec3(0.5f), -1}));
    builder.addLight("lamp", makePointLight(glm::vec3(1.0f)), {0.0, 3.0, 0.0});
    const Light solid = lightOf(std::move(builder).finish("solid"), options, inside);
    EXPECT_TRUE(isWarned(solid, "100.0 % of the points face the backs of surfaces: what is enclosed by backs counts as solid"));
    EXPECT_TRUE(isWarned(lightOf(like, options, wallsAround(8.0)), "1536 of 1536 points lie outside of the scene's bounds, by up to 4 m"));
}

TEST(Warnings, sayWhereCellsAreWiderThanWhatPointsSee) {
    const Scene room = rooms({glm::vec3(0.5f)});
    LightOptions options = optionsFor(false, 1024);
    for (const auto& [resolution, isWide] : {std::pair(1, true), std::pair(2, true), std::pair(8, false)}) {
        options.resolution = resolution;
        EXPECT_EQ(isWarned(lightOf(room, options, wallsAround(0.0)), "a tenth of the points see surfaces from"), isWide) << resolution;
    }
}

TEST(Sheets, aRoomWhoseWallsFaceOutwardsBesideOneWhoseFaceInwardsHasItsLight) {
    SceneBuilder builder("rooms");
    const std::uint32_t grey = builder.addMaterial({"grey", glm::vec3(0.5f), -1});
    builder.beginNode("inwards");
    addRoom(builder, grey);
    builder.addLight("bright", makePointLight(glm::vec3(2.0f)), {0.2, 0.1, -0.3});
    builder.beginNode("outwards");
    addBox(builder, {4, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, grey);
    builder.addLight("dim", makePointLight(glm::vec3(1.0f)), {4.2, 0.1, -0.3});
    const Scene scene = std::move(builder).finish("rooms");
    for (bool all : {false, true}) {
        LightOptions options = optionsFor(all, 1u << 20);
        options.resolution = 16;
        const double exact = (all ? 1.0 : 0.5) * kLampPower / 24.0;
        const Light inwards = lightOf(scene, options, wallsAround(0.0)), outwards = lightOf(scene, options, wallsAround(4.0));
        EXPECT_NEAR(meanIrradiance(inwards.irradiance), 2.0 * exact, 0.02 * 2.0 * exact);
        EXPECT_NEAR(meanIrradiance(outwards.irradiance), exact, 0.02 * exact);
        EXPECT_TRUE(isWarned(outwards, "33 % of the light falls on the backs of surfaces: nothing counts as solid"));
    }
}

// A house of sheets that face outwards, on a wide ground, with a window through which the sun shines: what falls on backs is too little to show.
TEST(Sheets, aHouseThatFacesOutwardsHasLightWherePointsAre) {
    const auto house = [](bool outwards) {
        SceneBuilder b("house");
        const std::uint32_t grey = b.addMaterial({"grey", glm::vec3(0.6f), -1});
        b.beginNode("house");
        const auto quad = [&](const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r, const glm::dvec3& s) {
            outwards ? b.addQuad(p, q, r, s, grey) : b.addQuad(s, r, q, p, grey);
        };
        quad({-2, 3, 2}, {2, 3, 2}, {2, 3, -2}, {-2, 3, -2});
        quad({-2, 0, -2}, {-2, 3, -2}, {2, 3, -2}, {2, 0, -2});
        quad({-2, 0, 2}, {-2, 3, 2}, {-2, 3, -2}, {-2, 0, -2});
        quad({2, 0, -2}, {2, 3, -2}, {2, 3, 2}, {2, 0, 2});
        // The front, around a window of 2 x 1.5 m.
        quad({-2, 0, 2}, {2, 0, 2}, {2, 1, 2}, {-2, 1, 2});
        quad({-2, 2.5, 2}, {2, 2.5, 2}, {2, 3, 2}, {-2, 3, 2});
        quad({-2, 1, 2}, {-1, 1, 2}, {-1, 2.5, 2}, {-2, 2.5, 2});
        quad({1, 1, 2}, {2, 1, 2}, {2, 2.5, 2}, {1, 2.5, 2});
        b.beginNode("ground");
        b.addQuad({-20, 0, 20}, {20, 0, 20}, {20, 0, -20}, {-20, 0, -20}, grey);
        b.addLight("sun", makeDirectionalLight(glm::vec3(0.2f, -0.7f, -0.7f), glm::vec3(10.0f)), {0, 0, 0});
        return std::move(b).finish("house");
    };
    std::vector<ReferencePoint> points;
    for (int k = 0; k < 64; ++k) {
        const float a = (float(k % 8) + 0.5f) * 0.5f - 2.0f, y = (float(k / 8) + 0.5f) * 0.375f;
        points.push_back({{a, y, -2.0f}, {0, 0, 1}});
        points.push_back({{-2.0f, y, a}, {1, 0, 0}});
    }
    LightOptions options = optionsFor(false, 1u << 20);
    options.resolution = 64;
    const Light outwards = lightOf(house(true), options, points), inwards = lightOf(house(false), options, points);
    EXPECT_TRUE(isWarned(outwards, "light is in there, and nothing counts as solid"));
    EXPECT_TRUE(inwards.report.warnings.empty());
    EXPECT_NEAR(meanIrradiance(outwards.irradiance) / meanIrradiance(inwards.irradiance), 1.0, 0.02);
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
