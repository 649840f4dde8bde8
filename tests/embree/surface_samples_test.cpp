// Samples of surfaces stand for their area, on the sides that light can reach.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "bindings/embree/surface_samples.h"
#include "bindings/embree/task_pool.h"
#include "embree/small_scenes.h"

namespace clv::test {
namespace {

constexpr std::size_t kCount = 4096;

SurfaceSamples samplesOf(const Scene& scene) { return sampleSurfaces(EmbreeScene(scene), kCount, 1, tbbParallelFor(2)); }

// A box whose faces look inwards, 2 x 1 x 3 m; the face at y = 0 is red, the others are white. A sheet of 0.5 m^2 may hang in it.
Scene insideOfABox(bool withSheet = false, double scale = 1.0) {
    SmallScene small;
    const auto red = small.material(glm::vec3(1, 0, 0)), white = small.material(glm::vec3(1.0f));
    const auto face = [&](const glm::dvec3& corner, const glm::dvec3& x, const glm::dvec3& y, std::uint32_t material) {
        small.rectangle(scale * corner, scale * x, scale * y, material);
    };
    face({0, 0, 0}, {0, 0, 3}, {2, 0, 0}, red);
    face({0, 1, 0}, {2, 0, 0}, {0, 0, 3}, white);
    face({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, white);
    face({0, 0, 3}, {0, 1, 0}, {2, 0, 0}, white);
    face({0, 0, 0}, {0, 1, 0}, {0, 0, 3}, white);
    face({2, 0, 0}, {0, 0, 3}, {0, 1, 0}, white);
    if (withSheet) small.triangle({0.5, 0.5, 1.0}, {1.5, 0.5, 1.0}, {1.0, 0.5, 2.0}, white);
    return small.finish();
}

TEST(SurfaceSamples, aClosedRoomIsSampledInsideOnlyAndInProportionToArea) {
    const SurfaceSamples samples = samplesOf(insideOfABox());
    EXPECT_FLOAT_EQ(samples.area[0], 22.0f / kCount);
    ASSERT_EQ(samples.receivers.size(), samples.albedo.size());
    EXPECT_NEAR(double(samples.receivers.size()), double(kCount), 0.002 * kCount);
    std::size_t onFloor = 0;
    for (std::size_t i = 0; i < samples.receivers.size(); ++i) {
        const ClvReceiver& r = samples.receivers[i];
        EXPECT_GT(glm::dot(r.normal, glm::vec3(1.0f, 0.5f, 1.5f) - r.position), 0.0f);
        const bool red = samples.albedo[i].y == 0.0f;
        EXPECT_EQ(red, r.normal.y > 0.5f);
        onFloor += red;
    }
    EXPECT_NEAR(double(onFloor) * samples.area[0], 6.0, 2.0 * samples.area[0]);
}

TEST(SurfaceSamples, areInAnOrderInWhichNeighboursAreNear) {
    const SurfaceSamples samples = samplesOf(insideOfABox());
    std::size_t near = 0, turns = 0;
    for (std::size_t i = 1; i < samples.receivers.size(); ++i) {
        const ClvReceiver &a = samples.receivers[i - 1], &b = samples.receivers[i];
        near += glm::length(a.position - b.position) < 3.0f * std::sqrt(samples.area[0]);
        turns += glm::dot(a.normal, b.normal) < 0.5f;
    }
    EXPECT_EQ(turns, 5u) << "each of six faces is left once";
    EXPECT_GT(near, samples.receivers.size() * 8 / 10);
}

TEST(SurfaceSamples, twoSheetsSendOnFromTheSidesThatSeeAFront) {
    // Sheets that face each other: outside there is nothing to see.
    SmallScene small;
    const auto white = small.material(glm::vec3(0.5f));
    small.rectangle({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, white);
    small.rectangle({0, 0.2, 0}, {1, 0, 0}, {0, 0, 1}, white);
    const SurfaceSamples samples = samplesOf(small.finish());
    ASSERT_GT(samples.receivers.size(), kCount / 2);
    EXPECT_LE(samples.receivers.size(), kCount);
    for (const ClvReceiver& r : samples.receivers) EXPECT_GT(r.normal.y * (0.1f - r.position.y), 0.0f);
}

TEST(SurfaceSamples, aSheetInARoomIsSampledOnBothSides) {
    const SurfaceSamples before = samplesOf(insideOfABox()), after = samplesOf(insideOfABox(true));
    std::size_t up = 0, down = 0;
    for (const ClvReceiver& r : after.receivers) {
        if (std::abs(r.position.y - 0.5f) > 1e-5f || std::abs(r.normal.y) < 0.5f) continue;
        (r.normal.y > 0.0f ? up : down)++;
    }
    EXPECT_NEAR(double(up) * after.area[0], 0.5, 2.0 * after.area[0]);
    EXPECT_EQ(up, down);
    EXPECT_FLOAT_EQ(after.area[0] - before.area[0], 0.5f / kCount);
}

TEST(SurfaceSamples, halfOfThemLieWhereViewsFallAndStandForLessAreaThere) {
    const Scene scene = insideOfABox();
    const glm::uvec3 half = scene.triangles[2];  // of the ceiling of 6 m^2
    const vec3 middle = (scene.positions[half.x] + scene.positions[half.y] + scene.positions[half.z]) / 3.0f;
    const std::vector<SurfaceView> views(10000, {2, middle});
    const SurfaceSamples samples = sampleSurfaces(EmbreeScene(scene), kCount, 1, tbbParallelFor(2), views);
    double area = 0.0, ceiling = 0.0;
    std::size_t onCeiling = 0;
    for (std::size_t i = 0; i < samples.receivers.size(); ++i) {
        const bool above = samples.receivers[i].normal.y < -0.5f;
        area += samples.area[i], ceiling += above ? samples.area[i] : 0.0, onCeiling += above;
    }
    EXPECT_NEAR(double(onCeiling), (0.5 + 0.5 * 6.0 / 22.0) * kCount, 0.005 * kCount);
    EXPECT_NEAR(area, 22.0, 0.05);
    EXPECT_NEAR(ceiling, 6.0, 0.05);
}

// Of a ceiling of 2 x 3 km a few square metres are seen: half of the samples lie about there, and stand for what they lie on.
TEST(SurfaceSamples, theSeenPartOfATriangleHasMoreOfThemThatStandForItsArea) {
    const Scene scene = insideOfABox(false, 1000.0);
    const vec3 seen(500.0f, 1000.0f, 700.0f);
    std::vector<SurfaceView> views;
    for (std::uint32_t i = 0; i < 1024; ++i) {
        const vec4 u = clvSobol4(i, 5u);
        views.push_back({2, seen + vec3(2.0f * u.x - 1.0f, 0.0f, 2.0f * u.y - 1.0f)});
    }
    const SurfaceSamples samples = sampleSurfaces(EmbreeScene(scene), kCount, 1, tbbParallelFor(2), views);
    std::size_t near = 0;
    double area = 0.0, seenArea = 0.0;
    for (std::size_t i = 0; i < samples.receivers.size(); ++i) {
        const vec3 away = glm::abs(samples.receivers[i].position - seen);
        const float distance = std::max({away.x, away.y, away.z});
        near += distance < 3.0f, area += samples.area[i], seenArea += distance < 1.0f ? samples.area[i] : 0.0;
    }
    EXPECT_GT(near, kCount * 45 / 100);
    EXPECT_NEAR(seenArea, 4.0, 0.2);
    EXPECT_NEAR(area, 22e6, 0.05e6);
}

TEST(SurfaceSamples, sightIsShortInAGapAndNotInACorner) {
    SmallScene small;
    const auto white = small.material(glm::vec3(1.0f));
    small.rectangle({0, 0, 0}, {0, 0, 3}, {2, 0, 0}, white);
    small.rectangle({0, 0.01, 0}, {2, 0, 0}, {0, 0, 3}, white);  // faces the first, 1 cm above it
    const SurfaceSamples gap = samplesOf(small.finish()), room = samplesOf(insideOfABox());
    ASSERT_GT(gap.receivers.size(), kCount / 2);
    ASSERT_EQ(gap.sight.size(), gap.receivers.size());
    for (const float sight : gap.sight) EXPECT_GE(sight, 0.0099f);
    EXPECT_GT(std::ranges::count_if(gap.sight, [](float sight) { return sight < 0.04f; }), std::ptrdiff_t(gap.sight.size() * 9 / 10));
    EXPECT_LT(std::ranges::count_if(room.sight, [](float sight) { return sight < 0.3f; }), std::ptrdiff_t(room.sight.size() / 50));
}

TEST(SurfaceSamples, areTheSameForASeedWhateverTheThreads) {
    const Scene scene = insideOfABox();
    const std::vector<SurfaceView> views(100, {2, scene.positions[scene.triangles[2].x]});
    for (const std::vector<SurfaceView>& seen : {std::vector<SurfaceView>(), views}) {
        const auto samples = [&](int threads, uint seed) { return sampleSurfaces(EmbreeScene(scene), kCount, seed, tbbParallelFor(threads), seen); };
        const SurfaceSamples one = samples(1, 1), two = samples(2, 1), other = samples(2, 2);
        ASSERT_EQ(one.receivers.size(), two.receivers.size());
        for (std::size_t i = 0; i < one.receivers.size(); ++i) EXPECT_EQ(one.receivers[i].position, two.receivers[i].position);
        EXPECT_EQ(one.area, two.area);
        EXPECT_NE(one.receivers[0].position, other.receivers[0].position);
    }
}

TEST(SurfaceSamples, lieOnTheirTrianglesWhereTheseAreCut) {
    SmallScene small;
    small.triangle({0, 0, 0}, {0, 0, 3}, {2, 0, 0}, small.material(glm::vec3(1.0f)));
    small.triangle({0, 1, 0}, {2, 1, 0}, {0, 1, 3}, small.material(glm::vec3(1.0f)));  // what they see
    const Scene scene = small.finish();
    std::vector<SurfaceView> views;
    for (std::uint32_t i = 0; i < 2000; ++i) {
        const vec4 u = clvSobol4(i, 9u);
        views.push_back({0, vec3(u.x * (2.0f - 2.0f * u.y / 3.0f), 0.0f, u.y)});
    }
    const SurfaceSamples samples = sampleSurfaces(EmbreeScene(scene), kCount, 1, tbbParallelFor(2), views);
    std::size_t below = 0;
    for (const ClvReceiver& r : samples.receivers) {
        if (r.position.y > 0.5f) continue;
        ++below;
        EXPECT_GE(r.position.x, 0.0f);
        EXPECT_GE(r.position.z, 0.0f);
        EXPECT_LE(r.position.x / 2.0f + r.position.z / 3.0f, 1.0f + 1e-6f);
    }
    EXPECT_GT(below, kCount / 2);
}

}  // namespace
}  // namespace clv::test
