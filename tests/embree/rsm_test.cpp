#include "bindings/embree/rsm.h"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "bindings/embree/task_pool.h"
#include "embree/small_scenes.h"
#include "support/z_test.h"

namespace clv::test {
namespace {

constexpr int kResolution = 48;

std::vector<ClvRsmTexel> rsmOf(const EmbreeScene& scene, const ClvLight& light, std::uint32_t pass, std::uint32_t seed,
                               const ParallelFor& parallelFor = serialFor(), int resolution = kResolution) {
    std::vector<ClvRsmTexel> texels(std::size_t(resolution) * std::size_t(resolution));
    renderRsm(scene, light, resolution, pass, seed, parallelFor, texels);
    return texels;
}

double fluxOf(const std::vector<ClvRsmTexel>& texels) {
    double sum = 0.0;
    for (const ClvRsmTexel& texel : texels) sum += texel.valid ? texel.flux.x : 0.0;
    return sum;
}

// The mean flux of maps with seeds of their own.
MeanOf meanFluxOf(const EmbreeScene& scene, const ClvLight& light) {
    MeanOf mean;
    for (std::uint32_t seed = 0; seed < 32; ++seed) mean.add(fluxOf(rsmOf(scene, light, 0, seed)));
    return mean;
}

// A wall of albedo 0.5 over [-2, 2]^2 at z = 0, and a screen over the corner x, y > 0 at z = 1 that is black.
Scene wallAndScreen() {
    SmallScene scene;
    scene.rectangle({-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, scene.material(glm::vec3(0.5f)));
    scene.rectangle({0, 0, 1}, {2, 0, 0}, {0, 2, 0}, scene.material(glm::vec3(0.0f)));
    return scene.finish();
}

// Solid angle, sr, of the rectangle [0, x] x [0, y] seen from a height z above its corner.
double solidAngleOfCorner(double x, double y, double z) { return std::atan(x * y / (z * std::sqrt(x * x + y * y + z * z))); }

TEST(RsmRender, closedRoomReflectsAllOfAPointLight) {
    const Scene scene = makeBuiltinScene("furnace_box");
    const EmbreeScene embree(scene);
    ASSERT_EQ(scene.lights[0].light.type, kClvLightPoint);
    const std::vector<ClvRsmTexel> texels = rsmOf(embree, scene.lights[0].light, 0, 1);
    for (const ClvRsmTexel& texel : texels) EXPECT_EQ(texel.valid, 1u);
    const double expected = 4.0 * M_PI * scene.lights[0].light.intensity.x * scene.materials[0].albedo.x;
    EXPECT_NEAR(fluxOf(texels) / expected, 1.0, 1e-5);
}

TEST(RsmRender, closedRoomReflectsAllOfASpot) {
    const Scene scene = makeBuiltinScene("furnace_box");
    const EmbreeScene embree(scene);
    ClvLight spot = makeSpotLight(glm::vec3(0.2f, -1.0f, 0.4f), glm::vec3(3.0f), 0.3f, 1.2f);
    spot.position = scene.lights[0].light.position;
    const double inner = std::cos(0.3), ramp = inner - std::cos(1.2);
    ZTest test;
    test.add("flux", meanFluxOf(embree, spot), 3.0 * scene.materials[0].albedo.x * 2.0 * M_PI * (ramp / 3.0 + 1.0 - inner));
    EXPECT_TRUE(test.agrees());
}

TEST(RsmRender, pointLightLeavesTheShadowOut) {
    const Scene scene = wallAndScreen();
    const EmbreeScene embree(scene);
    ClvLight lamp = makePointLight(glm::vec3(1.0f));
    lamp.position = glm::vec3(0.0f, 0.0f, 2.0f);
    // Three quarters of the wall are lit; of the fourth the screen throws its whole shadow of [0, 4]^2.
    ZTest test;
    test.add("flux", meanFluxOf(embree, lamp), 0.5 * 3.0 * solidAngleOfCorner(2, 2, 2));
    EXPECT_TRUE(test.agrees());
}

// A map of the whole sphere, or of the whole cone, would have no texel on the wall from here.
TEST(RsmRender, lampsFarAwaySpendTheirMapOnTheScene) {
    const Scene scene = wallAndScreen();
    const EmbreeScene embree(scene);
    for (float distance : {10.0f, 1e3f, 1e5f}) {
        for (ClvLight lamp : {makePointLight(glm::vec3(1.0f)), makeSpotLight(glm::vec3(0.0f, 0.0f, -1.0f), glm::vec3(1.0f), 1.0f, 1.2f)}) {
            lamp.position = glm::vec3(0.0f, 0.0f, distance);
            ZTest test;
            // The black screen hides one quarter of the wall.
            test.add("flux", meanFluxOf(embree, lamp), 0.5 * 3.0 * solidAngleOfCorner(2, 2, distance));
            EXPECT_TRUE(test.agrees()) << distance << " type " << lamp.type;
        }
    }
}

// Rays that leave a texel behind its own surface meet that surface first.
TEST(RsmRender, whatLampsFarAwayMeetHasTheAccuracyOfTheScene) {
    const Scene scene = wallAndScreen();
    const EmbreeScene embree(scene);
    for (const float distance : {10.0f, 1e3f, 1e5f, 1e7f, 1e9f}) {
        ClvLight point = makePointLight(glm::vec3(1.0f));
        point.position = distance * glm::normalize(glm::vec3(0.3f, 0.2f, 1.0f));
        ClvLight spot = point;
        spot.type = kClvLightSpot;
        spot.direction = -glm::normalize(point.position);
        // Wider than the scene seen from there, and narrower.
        for (const float cone : {0.0f, 1.0f, 0.5f / distance}) {
            if (cone > 0.0f && cone < 1e-5f) continue;  // a light of so narrow a cone is not aimed by floats
            ClvLight light = cone > 0.0f ? spot : point;
            light.outerConeAngle = cone;
            const auto texels = rsmOf(embree, light, 0, 1, serialFor(), 128);
            int valid = 0;
            for (const ClvRsmTexel& texel : texels) {
                if (texel.valid == 0u) continue;
                ++valid;
                const float plane = texel.position.x > 0.0f && texel.position.y > 0.0f && texel.position.z > 0.5f ? 1.0f : 0.0f;
                EXPECT_NEAR(texel.position.z, plane, 0.5f * embree.surfaceOffset()) << distance << " m, cone " << cone;
            }
            EXPECT_GT(valid, 2000) << distance << " m, cone " << cone;
            if (cone == 0.5f / distance) continue;
            // Flux on a wall of 16 m^2 that half reflects and a black screen: I cos / r^2 by the area that is not hidden.
            const double cosine = std::abs(light.position.z) / distance, hidden = 4.0;
            const double expected = 0.5 * (16.0 - hidden) * cosine / (double(distance) * distance);
            if (distance > 100.0f) {
                EXPECT_NEAR(fluxOf(texels) / expected, 1.0, 0.03) << distance << " m, cone " << cone;
            }
        }
    }
}

TEST(RsmRender, directionalLightLightsWhatItsProjectionCovers) {
    const Scene scene = wallAndScreen();
    const EmbreeScene embree(scene);
    const glm::vec3 direction = glm::normalize(glm::vec3(0.5f, 0.25f, -1.0f));
    // The screen's shadow on the wall is [0.5, 2] x [0.25, 2].
    const double lit = 16.0 - 1.5 * 1.75;
    ZTest test;
    test.add("flux", meanFluxOf(embree, makeDirectionalLight(direction, glm::vec3(2.0f))), 0.5 * 2.0 * lit * -direction.z);
    EXPECT_TRUE(test.agrees());
}

TEST(RsmRender, meanOverPassesConvergesToTheShadowEdge) {
    const Scene scene = wallAndScreen();
    const EmbreeScene embree(scene);
    ClvLight lamp = makePointLight(glm::vec3(1.0f));
    lamp.position = glm::vec3(0.1f, 0.2f, 2.0f);
    // The screen's shadow begins where lines through its edges end: x = -0.1, y = -0.2.
    double expected = 0.0;
    for (glm::dvec2 side : {glm::dvec2(2.1, 2.2), glm::dvec2(2.1, 1.8), glm::dvec2(1.9, 2.2), glm::dvec2(1.9, 1.8)}) {
        expected += solidAngleOfCorner(side.x, side.y, 2.0);
    }
    for (glm::dvec2 sign : {glm::dvec2(1, 1), glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(0, 0)}) {
        expected -= solidAngleOfCorner(sign.x > 0 ? 1.9 : 0.2, sign.y > 0 ? 1.8 : 0.4, 2.0);
    }
    const auto meanAfter = [&](std::uint32_t passes) {
        MeanOf mean;
        for (std::uint32_t seed = 0; seed < 16; ++seed) {
            double sum = 0.0;
            for (std::uint32_t pass = 0; pass < passes; ++pass) sum += fluxOf(rsmOf(embree, lamp, pass, seed, serialFor(), 16));
            mean.add(sum / passes);
        }
        return mean;
    };
    const MeanOf one = meanAfter(1), many = meanAfter(64);
    ZTest test;
    test.add("one pass", one, 0.5 * expected);
    test.add("64 passes", many, 0.5 * expected);
    EXPECT_TRUE(test.agrees());
    // Independent passes would gain a factor of 8.
    EXPECT_LT(many.standardError(), one.standardError() / 12.0);
}

TEST(RsmRender, texelsLieOnWhatTheLightMetFirst) {
    const Scene scene = wallAndScreen();
    const EmbreeScene embree(scene);
    ClvLight lamp = makePointLight(glm::vec3(1.0f));
    lamp.position = glm::vec3(0.3f, 0.2f, 2.0f);
    int onScreen = 0;
    for (const ClvRsmTexel& texel : rsmOf(embree, lamp, 0, 1)) {
        if (!texel.valid) continue;
        const bool screen = texel.position.z > 0.5f;
        onScreen += screen;
        EXPECT_NEAR(texel.position.z, screen ? 1.0f : 0.0f, 1e-6f);
        EXPECT_EQ(texel.normal, glm::vec3(0, 0, 1));
        EXPECT_EQ(texel.flux.x > 0.0f, !screen);
    }
    EXPECT_GT(onScreen, 0);
}

TEST(RsmRender, normalsTurnToTheLightOnBackFacesToo) {
    const Scene scene = wallAndScreen();
    const EmbreeScene embree(scene);
    ClvLight lamp = makePointLight(glm::vec3(1.0f));
    lamp.position = glm::vec3(0.3f, 0.2f, -2.0f);
    for (const ClvRsmTexel& texel : rsmOf(embree, lamp, 0, 1)) {
        if (texel.valid) { EXPECT_EQ(texel.normal, glm::vec3(0, 0, -1)); }
    }
}

TEST(RsmRender, threadsDoNotChangeABit) {
    const Scene scene = makeBuiltinScene("cornell");
    const EmbreeScene embree(scene);
    const ParallelFor backwards = [](std::size_t count, const std::function<void(std::size_t)>& body) {
        while (count > 0) body(--count);
    };
    const std::vector<ClvRsmTexel> expected = rsmOf(embree, scene.lights[0].light, 3, 5);
    for (const ParallelFor& parallelFor : {tbbParallelFor(2), backwards}) {
        const std::vector<ClvRsmTexel> texels = rsmOf(embree, scene.lights[0].light, 3, 5, parallelFor);
        EXPECT_EQ(std::memcmp(texels.data(), expected.data(), texels.size() * sizeof(ClvRsmTexel)), 0);
    }
}

TEST(RsmRender, resolutionsThatFillNoPacketWork) {
    const Scene scene = makeBuiltinScene("furnace_box");
    const EmbreeScene embree(scene);
    const double expected = 4.0 * M_PI * scene.lights[0].light.intensity.x * scene.materials[0].albedo.x;
    for (int resolution : {1, 2, 17, 65}) {
        EXPECT_NEAR(fluxOf(rsmOf(embree, scene.lights[0].light, 0, 1, serialFor(), resolution)) / expected, 1.0, 1e-5) << resolution;
    }
}

}  // namespace
}  // namespace clv::test
