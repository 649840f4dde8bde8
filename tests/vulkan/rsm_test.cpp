// The rsm step renders the maps that Embree renders, and their running sums.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bindings/embree/rsm.h"
#include "bindings/scene/scene_builder.h"
#include "clv/math/hash.h"
#include "clv/stages/pick_texel.h"
#include "clv/stages/rays.h"
#include "vulkan/traced_scene.h"

namespace clv::test {
namespace {

constexpr std::uint32_t kRays = 64;

double fluxOf(std::span<const ClvRsmTexel> texels) {
    double sum = 0.0;
    for (const ClvRsmTexel& texel : texels) sum += texel.valid ? texel.flux.x : 0.0;
    return sum;
}

// A lamp of each type.
Scene lampsOver(const std::string& name) {
    Scene scene = makeBuiltinScene(name);
    const glm::vec3 center = scene.bounds.center();
    const glm::vec3 down = glm::normalize(glm::vec3(0.3f, -1.0f, 0.2f));
    ClvLight point = makePointLight(glm::vec3(1, 2, 3)), spot = makeSpotLight(down, glm::vec3(3, 2, 1), 0.2f, 0.7f);
    point.position = spot.position = center;
    scene.lights = {{"point", point}, {"spot", spot}, {"sun", makeDirectionalLight(down, glm::vec3(1.0f))}};
    return scene;
}

// Texels that may be found elsewhere than on the host, as a share of a map, and how far the flux of a map may be off, relatively.
struct Slack {
    double elsewhere, flux;
};
// Sines of the device differ in the last bits: a ray next to an edge may meet the other side of it.
constexpr Slack kTraced{1e-3, 1e-4};

// Compares every texel with the host's; returns how many of them were found elsewhere, which may be up to slack.elsewhere of a map.
std::size_t expectTexelsOfTheHost(TracedScene& traced, std::uint32_t side, const Slack& slack = kTraced) {
    const TracedScene::Results results = runInBothLanguages(traced);
    const std::size_t each = std::size_t(side) * side;
    const float reach = glm::length(traced.scene.bounds.extent());
    std::vector<ClvRsmTexel> expected(each);
    std::size_t allElsewhere = 0;
    for (std::size_t k = 0; k < traced.lights.size(); ++k) {
        renderRsm(traced.embree, traced.lights[k], int(side), traced.constants.rsmPass, clvHashCombine(traced.constants.rsmSeed, uint(k)), serialFor(), expected);
        const std::span<const ClvRsmTexel> texels = std::span(results.texels).subspan(k * each, each);
        float brightest = 0.0f;
        for (const ClvRsmTexel& texel : expected) brightest = std::max(brightest, length(texel.flux));
        std::size_t elsewhere = 0;
        for (std::size_t i = 0; i < each; ++i) {
            if (texels[i].valid != expected[i].valid || (texels[i].valid && length(texels[i].position - expected[i].position) > 1e-5f * reach)) {
                ++elsewhere;
                continue;
            }
            if (!texels[i].valid) continue;
            EXPECT_LT(length(texels[i].normal - expected[i].normal), 1e-5f) << k << " " << i;
            // At the rim of a cone the falloff is a small difference of cosines.
            EXPECT_LE(length(texels[i].flux - expected[i].flux), 1e-5f * brightest) << k << " " << i;
            EXPECT_EQ(texels[i].dynamicity, expected[i].dynamicity);
        }
        EXPECT_LE(double(elsewhere), slack.elsewhere * double(each)) << k;
        EXPECT_NEAR(fluxOf(texels) / fluxOf(expected), 1.0, slack.flux) << k;
        allElsewhere += elsewhere;
    }
    return allElsewhere;
}

TEST(VulkanRsm, texelsAreThoseOfTheHostForEveryTypeOfLight) {
    for (const char* name : {"cornell", "atrium"}) {
        SCOPED_TRACE(name);
        TracedScene traced(lampsOver(name), 48, kRays, false);
        expectTexelsOfTheHost(traced, 48);
    }
}

TEST(VulkanRsm, texelsInPaintedScenesHaveTheTexturesColour) {
    TracedScene traced(paintedCornell(), 48, kRays, false);
    expectTexelsOfTheHost(traced, 48);
}

// Where maps are drawn, texels at outlines differ: the triangle that a ray meets is in none of the four texels around it. Measured with
// pictures of 192 texels a side: at most 2.9 % of a map's texels, those of the atrium's sun, and 0.6 % of its flux.
constexpr Slack kDrawn{0.03, 0.006};

TEST(VulkanRsm, drawnTexelsAreThoseOfTheHostButForOutlines) {
    for (const char* name : {"cornell", "two_rooms", "atrium"}) {
        SCOPED_TRACE(name);
        TracedScene traced(lampsOver(name), 48, kRays, false);
        traced.drawMaps(192);
        expectTexelsOfTheHost(traced, 48, kDrawn);
    }
}

TEST(VulkanRsm, drawnTexelsInPaintedScenesHaveTheTexturesColour) {
    TracedScene traced(paintedCornell(), 48, kRays, false);
    traced.drawMaps(192);
    expectTexelsOfTheHost(traced, 48, kDrawn);
}

// A cone that is too wide for one picture.
TEST(VulkanRsm, drawnTexelsFillWideCones) {
    for (const float angle : {kWidestFace, 0.5f * kClvPi}) {
        Scene scene = makeBuiltinScene("cornell");
        ClvLight spot = makeSpotLight(glm::normalize(glm::vec3(0.3f, -1.0f, 0.2f)), glm::vec3(3, 2, 1), 0.5f * angle, angle);
        spot.position = scene.bounds.center();
        scene.lights = {{"spot", spot}};
        TracedScene traced(std::move(scene), 48, kRays, false);
        traced.drawMaps(192);
        EXPECT_EQ(traced.faces.size(), angle > kWidestFace ? 5u : 1u);
        expectTexelsOfTheHost(traced, 48, kDrawn);
    }
}

// Outlines are lines: with texels of a quarter of the side, a quarter of the texels of a map lie on one.
TEST(VulkanRsm, drawnOutlinesThinOutWithTheSizeOfThePictures) {
    TracedScene traced(lampsOver("atrium"), 48, kRays, false);
    traced.drawMaps(64);
    const std::size_t coarse = expectTexelsOfTheHost(traced, 48, {0.12, 0.012});
    traced.drawMaps(256);
    const std::size_t fine = expectTexelsOfTheHost(traced, 48, kDrawn);
    EXPECT_GT(coarse, 100u) << "the test says little";
    EXPECT_LT(double(fine), 0.35 * double(coarse));
}

TEST(VulkanRsm, drawnMapsOfAClosedRoomReflectAllOfAPointLight) {
    TracedScene traced(makeBuiltinScene("furnace_box"), 64, kRays, false);
    traced.drawMaps(64);
    const TracedScene::Results results = runInBothLanguages(traced);
    for (const ClvRsmTexel& texel : results.texels) EXPECT_EQ(texel.valid, 1u);
    const double expected = 4.0 * M_PI * traced.lights[0].intensity.x * traced.scene.materials[0].albedo.x;
    EXPECT_NEAR(fluxOf(results.texels) / expected, 1.0, 1e-5);
}

TEST(VulkanRsm, closedRoomReflectsAllOfAPointLight) {
    TracedScene traced(makeBuiltinScene("furnace_box"), 64, kRays, false);
    const TracedScene::Results results = runInBothLanguages(traced);
    for (const ClvRsmTexel& texel : results.texels) EXPECT_EQ(texel.valid, 1u);
    const double expected = 4.0 * M_PI * traced.lights[0].intensity.x * traced.scene.materials[0].albedo.x;
    EXPECT_NEAR(fluxOf(results.texels) / expected, 1.0, 1e-5);
}

// `sums` [first, first + weights.size()] against sums in double precision.
void expectRunningSums(const std::vector<float>& sums, std::size_t first, const std::vector<double>& weights) {
    double total = 0.0, sum = 0.0;
    for (const double weight : weights) total += weight;
    if (total == 0.0) {
        for (std::size_t i = 0; i <= weights.size(); ++i) ASSERT_EQ(sums[first + i], 1.0f) << i;
        return;
    }
    ASSERT_EQ(sums[first], 0.0f);
    // Each addition errs by half a unit in the last place of the total at most.
    const double bound = double(weights.size()) * std::numeric_limits<float>::epsilon();
    for (std::size_t i = 0; i < weights.size(); ++i) {
        sum += weights[i];
        ASSERT_NEAR(sums[first + i + 1], sum / total, bound) << i;
        ASSERT_GE(sums[first + i + 1], sums[first + i]) << i;
    }
    ASSERT_EQ(sums[first + weights.size()], 1.0f);
}

TEST(VulkanTexelSums, runOverEachRowAndOverAllRows) {
    // Sides with fewer texels than a work group has threads, and with more, even and odd.
    for (const std::uint32_t side : {1u, 2u, 17u, 64u, 100u, 129u}) {
        SCOPED_TRACE(side);
        TracedScene traced(lampsOver("atrium"), side, kRays, false);
        const TracedScene::Results results = runInBothLanguages(traced);
        const std::size_t rows = traced.lights.size() * side;
        std::vector<double> flux;
        for (std::size_t row = 0; row < rows; ++row) {
            std::vector<double> weights;
            for (std::size_t i = 0; i < side; ++i) weights.push_back(clvTexelWeight(results.texels[row * side + i]));
            expectRunningSums(results.sums, row * (side + 1), weights);
            flux.push_back(0.0);
            for (const double weight : weights) flux.back() += weight;
        }
        expectRunningSums(results.sums, rows * (side + 1), flux);
    }
}

TEST(VulkanTexelSums, ofDarknessAreOneThroughout) {
    Scene scene = makeBuiltinScene("cornell");
    for (NamedLight& light : scene.lights) light.light.intensity = vec3(0.0f);
    TracedScene traced(std::move(scene), 16, kRays, false);
    for (const float sum : runInBothLanguages(traced).sums) EXPECT_EQ(sum, 1.0f);
}

}  // namespace
}  // namespace clv::test
