// This library behind the interface of the comparison: what it reads, and that its settings change what they say they change.
#include <algorithm>

#include <gtest/gtest.h>

#include "baselines/method_run.h"
#include "benchmarks/baselines/light_volume.h"
#include "furnace/surface_points.h"
#include "support/z_test.h"

namespace clv::test {
namespace {

std::vector<glm::vec3> lightOf(const MeasuredRoom& room, const LightVolumeSettings& settings, int frames, std::size_t rays) {
    const auto method = makeLightVolume(settings);
    method->prepare(room.world(), room.points);
    return lightAfter(*method, room, 1, frames, rays);
}

double errorOf(const MeasuredRoom& room, const LightVolumeSettings& settings, int frames, std::size_t rays) {
    return relativeErrors(lightOf(room, settings, frames, rays), room.trueIrradiance()).rmse;
}

TEST(LightVolumeMethod, furnacesReadTheirClosedForms) {
    // One bounce gives rho Phi / A, as a mean over the walls, and in the sphere everywhere.
    const struct { const char* name; double rho; } furnaces[] = {{"white_sphere", 0.8}, {"furnace_box", 0.5}};
    for (const auto& [name, rho] : furnaces) {
        MeasuredRoom room(name);
        room.points = surfacePoints(room.scene, 400, 5);
        MeanOf mean;
        for (const glm::vec3& e : lightOf(room, {.resolution = 24, .readers = Readers::receivers}, 2, 1 << 20)) mean.add(e.x);
        EXPECT_NEAR(mean.mean() / (rho * 4.0 * M_PI / surfaceArea(room.scene)), 1.0, 0.02) << name;
    }
}

TEST(LightVolumeMethod, convergesToTheTruth) {
    const MeasuredRoom room("cornell", 400, 4096);
    const LightVolumeSettings settings{.resolution = 32, .gridShift = {0.13f, 0.57f, 0.31f}, .readers = Readers::receivers};
    EXPECT_LT(errorOf(room, settings, 4, 1 << 20), 0.05);
}

TEST(LightVolumeMethod, framesAddUp) {
    const MeasuredRoom room("cornell", 300, 4096);
    const LightVolumeSettings settings{.resolution = 32, .readers = Readers::receivers};
    EXPECT_LT(errorOf(room, settings, 16, 32 << 10), 0.4 * errorOf(room, settings, 1, 32 << 10));
}

// However the light is read: trilinear interpolation blurs more of it than the linear fit does, and needs finer cells.
class ChosenResolution : public testing::TestWithParam<unsigned> {};

TEST_P(ChosenResolution, isAboutAsGoodAsTheBestFixedOne) {
    const MeasuredRoom room("cornell", 200, 4096);
    const std::size_t counts[] = {2 << 10, 64 << 10, 512 << 10};
    double chosen[3] = {}, best[3] = {1.0, 1.0, 1.0};
    for (const int resolution : {0, 8, 16, 32, 64}) {
        const auto method = makeLightVolume({.resolution = resolution, .readers = Readers::receivers, .lookup = GetParam()});
        method->prepare(room.world(), room.points);
        for (int k = 0; k < 3; ++k) {
            const auto light = lightAfter(*method, room, 1, 1, counts[k]);
            const double error = relativeErrors(light, room.trueIrradiance()).rmse;
            if (resolution == 0) {
                chosen[k] = error;
                EXPECT_EQ(light, lightAfter(*method, room, 1, 1, counts[k])) << "the choice does not follow from the seed";
            } else {
                best[k] = std::min(best[k], error);
            }
        }
    }
    for (int k = 0; k < 3; ++k) EXPECT_LT(chosen[k], 1.15 * best[k]) << counts[k];
}

INSTANTIATE_TEST_SUITE_P(Lookups, ChosenResolution, testing::Values(kClvLookupTrilinear, kClvLookupLinearFit));

TEST(LightVolumeMethod, whoElseReadsDoesNotMatter) {
    const MeasuredRoom room("two_rooms", 100, 1);
    const auto alone = lightOf(room, {.resolution = 12, .readers = Readers::receivers}, 1, 64 << 10);
    const auto amongSurfaces = lightOf(room, {.resolution = 12, .readers = Readers::surfaces}, 1, 64 << 10);
    const auto anywhere = lightOf(room, {.resolution = 12, .readers = Readers::anywhere}, 1, 64 << 10);
    for (std::size_t i = 0; i < alone.size(); ++i) {
        EXPECT_LT(glm::distance(alone[i], amongSurfaces[i]), 1e-4f * (1.0f + glm::length(alone[i]))) << i;
        EXPECT_LT(glm::distance(alone[i], anywhere[i]), 1e-4f * (1.0f + glm::length(alone[i]))) << i;
    }
}

TEST(LightVolumeMethod, weightsFoundAtEachReadingAreThoseThatAreKept) {
    const MeasuredRoom room("cornell", 100, 1);
    const auto kept = lightOf(room, {.resolution = 16, .readers = Readers::receivers}, 1, 16 << 10);
    EXPECT_EQ(kept, lightOf(room, {.resolution = 16, .readers = Readers::receivers, .keptWeights = false}, 1, 16 << 10));
}

TEST(LightVolumeMethod, aSphereReadsTheSameInEachWay) {
    MeasuredRoom room("white_sphere");
    room.points = surfacePoints(room.scene, 200, 5);
    for (const uint lookup : {kClvLookupNearest, kClvLookupTrilinear, kClvLookupLinearFit}) {
        MeanOf mean;
        for (const glm::vec3& e : lightOf(room, {.resolution = 16, .readers = Readers::receivers, .lookup = lookup}, 1, 1 << 18)) mean.add(e.x);
        EXPECT_NEAR(mean.mean() / (0.8 * 4.0 * M_PI / surfaceArea(room.scene)), 1.0, 0.02) << lookup;
    }
}

TEST(LightVolumeMethod, enoughRaysAreGuidedWhereMuchLightLeaves) {
    const MeasuredRoom room("atrium", 20, 1);
    const LightVolumeSettings guided{.resolution = 8, .readers = Readers::receivers}, unguided{.resolution = 8, .readers = Readers::receivers, .guided = false};
    EXPECT_NE(lightOf(room, guided, 1, 16 << 10), lightOf(room, unguided, 1, 16 << 10));
    EXPECT_EQ(lightOf(room, guided, 1, 8 << 10), lightOf(room, unguided, 1, 8 << 10));
}

TEST(LightVolumeMethod, lightFollowsFromTheSeed) {
    expectLightFollowsFromTheSeed([] { return makeLightVolume({.resolution = 12, .readers = Readers::receivers}); }, 16 << 10);
}

TEST(LightVolumeMethod, countsItsRaysAndForgetsThem) {
    const MeasuredRoom room("cornell", 50, 1);
    const auto method = makeLightVolume({.resolution = 16, .readers = Readers::receivers});
    method->prepare(room.world(), room.points);
    lightAfter(*method, room, 1, 2, 16 << 10);
    EXPECT_EQ(method->raysTraced(), 32u << 10);
    expectNothingAfterRestart(*method, room);
}

}  // namespace
}  // namespace clv::test
