// Patches cover each triangle once, and are small where views fall.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "bindings/embree/surface_patches.h"
#include "clv/math/sobol.h"
#include "embree/small_scenes.h"

namespace clv::test {
namespace {

// Two triangles: of 600 x 400 m, and of 2 x 1 m.
Scene wideAndSmall() {
    SmallScene small;
    const auto white = small.material(glm::vec3(1.0f));
    small.triangle({-100, 5, -50}, {500, 5, -50}, {-100, 5, 350}, white);
    small.triangle({0, 0, 0}, {2, 0, 0}, {0, 0, 1}, white);
    return small.finish();
}

bool isInside(const SurfacePatch& patch, double v1, double v2) {
    const double w1 = (v1 - double(patch.v1)) / double(patch.size), w2 = (v2 - double(patch.v2)) / double(patch.size);
    return w1 > 0.0 && w2 > 0.0 && w1 + w2 < 1.0;
}

double sumOf(const std::vector<SurfacePatch>& patches, float SurfacePatch::*what, std::uint32_t triangle) {
    double sum = 0.0;
    for (const SurfacePatch& patch : patches) sum += patch.triangle == triangle ? double(patch.*what) : 0.0;
    return sum;
}

TEST(SurfacePatches, fewViewsShareByArea) {
    const Scene scene = wideAndSmall();
    for (std::size_t views : {0u, 15u}) {
        const std::vector<SurfacePatch> patches = patchesWhereSeen(scene, std::vector<SurfaceView>(views, {1, vec3(0.5f, 0.0f, 0.2f)}));
        ASSERT_EQ(patches.size(), 2u);
        for (std::uint32_t t = 0; t < 2; ++t) {
            EXPECT_EQ(patches[t].triangle, t);
            EXPECT_EQ(patches[t].size, 1.0f);
            EXPECT_FLOAT_EQ(patches[t].area, t == 0 ? 120000.0f : 1.0f);
            EXPECT_FLOAT_EQ(patches[t].share, patches[t].area / 120001.0f);
        }
    }
    // One more, and they count: 16 of the 20 that there are with those that are shared by area.
    const std::vector<SurfacePatch> patches = patchesWhereSeen(scene, std::vector<SurfaceView>(16, {1, vec3(0.5f, 0.0f, 0.2f)}));
    EXPECT_NEAR(sumOf(patches, &SurfacePatch::share, 1), (16.0 + 4.0 / 120001.0) / 20.0, 1e-6);
}

// Samples are stratified along the patches: where there are few views these are in the order of the mesh, whose neighbours are near each other.
TEST(SurfacePatches, keepTheOrderOfTheMeshWhereFewAreSeen) {
    const Scene scene = triangleSoup(5000, 0.1f, 1);
    const glm::uvec3& c = scene.triangles[1234];
    const vec3 middle = (scene.positions[c.x] + scene.positions[c.y] + scene.positions[c.z]) / 3.0f;
    const std::vector<SurfacePatch> patches = patchesWhereSeen(scene, std::vector<SurfaceView>(500, {1234, middle}));
    std::vector<int> times(scene.triangles.size(), 0);
    std::size_t falls = 0;
    for (std::size_t i = 0; i < patches.size(); ++i) {
        times[patches[i].triangle] = 1;
        falls += i > 0 && patches[i].triangle < patches[i - 1].triangle;
    }
    EXPECT_EQ(std::ranges::count(times, 1), 5000);
    EXPECT_LT(falls, 30u) << "one a branch at the most";
}

// Small triangles on a wide one.
TEST(SurfacePatches, smallTrianglesThatAreSeenKeepTheirShareBesideALargeOne) {
    SmallScene small;
    const auto white = small.material(glm::vec3(1.0f));
    for (int i = 0; i < 40; ++i) small.triangle({0.2 * i, 0, 0}, {0.2 * i, 0, 0.1}, {0.2 * i + 0.1, 0, 0}, white);
    small.rectangle({-500, 0, -500}, {0, 0, 1000}, {1000, 0, 0}, white);
    const Scene scene = small.finish();
    std::vector<SurfaceView> views;
    for (std::uint32_t i = 0; i < 400; ++i) views.push_back({i % 40, scene.positions[scene.triangles[i % 40].x]});
    for (std::uint32_t i = 0; i < 400; ++i) views.push_back({40, vec3(-400.0f, 0.0f, -400.0f)});
    const std::vector<SurfacePatch> patches = patchesWhereSeen(scene, views);
    for (std::uint32_t t = 0; t < 40; ++t) EXPECT_NEAR(sumOf(patches, &SurfacePatch::share, t), 0.5 / 40.0, 0.2 * 0.5 / 40.0);
}

TEST(SurfacePatches, coverEachTriangleOnceAndAreSmallWhereViewsFall) {
    const Scene scene = wideAndSmall();
    const vec3 seen(20.0f, 5.0f, 30.0f);
    std::vector<SurfaceView> views(3, {1, vec3(0.5f, 0.0f, 0.2f)});
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const vec4 u = clvSobol4(i, 1u);
        views.push_back({0, seen + vec3(u.x - 0.5f, 0.0f, u.y - 0.5f)});
    }
    const std::vector<SurfacePatch> patches = patchesWhereSeen(scene, views);
    EXPECT_FLOAT_EQ(sumOf(patches, &SurfacePatch::area, 0), 120000.0f);
    EXPECT_NEAR(sumOf(patches, &SurfacePatch::share, 0), 1000.0 / 1003.0, 0.005);
    EXPECT_NEAR(sumOf(patches, &SurfacePatch::share, 0) + sumOf(patches, &SurfacePatch::share, 1), 1.0, 1e-6);
    double small = 0.0;
    for (const SurfacePatch& patch : patches) {
        EXPECT_GT(patch.share, 0.0f);
        EXPECT_FLOAT_EQ(patch.area, (patch.triangle == 0 ? 120000.0f : 1.0f) * patch.size * patch.size);
        small += patch.triangle == 0 && std::abs(patch.size) * 600.0f < 1.0f ? double(patch.share) : 0.0;
    }
    EXPECT_GT(small, 0.9) << "in patches as small as the square metre that is seen";
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const vec4 u = clvSobol4(i, 2u);
        // In the whole triangle, and about the seen place.
        const double v1 = i % 2 == 0 ? double(u.x) : 0.2 + 0.002 * double(u.x), v2 = i % 2 == 0 ? double(u.y) * (1.0 - v1) : 0.2 + 0.002 * double(u.y);
        int inside = 0;
        for (const SurfacePatch& patch : patches) inside += patch.triangle == 0 && isInside(patch, v1, v2);
        EXPECT_EQ(inside, 1) << v1 << ", " << v2;
    }
}

// Of a floor of many triangles a few get no view by chance. A sample there must not stand for much more area than its neighbours do: its light
// would be a bright spot.
TEST(SurfacePatches, whatHasNoViewByChanceHasAboutTheShareOfItsNeighbours) {
    constexpr int kSteps = 100;
    SmallScene small;
    const auto white = small.material(glm::vec3(1.0f));
    for (int x = 0; x < kSteps; ++x) {
        for (int z = 0; z < kSteps; ++z) small.rectangle({0.01 * x, 0, 0.01 * z}, {0, 0, 0.01}, {0.01, 0, 0}, white);
    }
    small.rectangle({-500, -1, -500}, {0, 0, 1000}, {1000, 0, 0}, white);
    const Scene scene = small.finish();
    std::vector<SurfaceView> views;
    std::vector<int> counts(scene.triangles.size(), 0);
    for (std::uint32_t i = 0; i < 4000; ++i) {
        const auto t = std::uint32_t(randomUnit(3, i) * float(2 * kSteps * kSteps));
        const glm::uvec3& c = scene.triangles[t];
        views.push_back({t, (scene.positions[c.x] + scene.positions[c.y] + scene.positions[c.z]) / 3.0f});
        ++counts[t];
    }
    int unseen = 0;
    for (const SurfacePatch& patch : patchesWhereSeen(scene, views)) {
        if (patch.triangle >= 2 * kSteps * kSteps) continue;
        const float fair = patch.area;  // of the square metre
        unseen += counts[patch.triangle] == 0;
        EXPECT_GT(patch.share, 0.2f * fair);
        EXPECT_LT(patch.share, 5.0f * fair);
    }
    EXPECT_GT(unseen, kSteps * kSteps);
}

TEST(SurfacePatches, manyViewsOfOnePlaceEnd) {
    const Scene scene = wideAndSmall();
    const std::vector<SurfacePatch> patches = patchesWhereSeen(scene, std::vector<SurfaceView>(100, {0, vec3(20.0f, 5.0f, 30.0f)}));
    EXPECT_FLOAT_EQ(sumOf(patches, &SurfacePatch::area, 0), 120000.0f);
    EXPECT_LT(patches.size(), 100u);
}

// Views lie on their triangle but for rounding: a place beside it, or on one without area, is no reason to fail.
TEST(SurfacePatches, viewsBesideTheirTriangleAreCounted) {
    Scene scene = wideAndSmall();
    scene.positions[scene.triangles[1].z] = scene.positions[scene.triangles[1].y];
    std::vector<SurfaceView> views(50, {1, vec3(1.0f, 0.0f, 0.0f)});
    for (int i = 0; i < 50; ++i) views.push_back({0, vec3(-100.1f - float(i), 5.0f, -51.0f)});
    const std::vector<SurfacePatch> patches = patchesWhereSeen(scene, views);
    EXPECT_NEAR(sumOf(patches, &SurfacePatch::share, 0) + sumOf(patches, &SurfacePatch::share, 1), 1.0, 1e-6);
    EXPECT_FLOAT_EQ(sumOf(patches, &SurfacePatch::area, 0), 120000.0f);
}

}  // namespace
}  // namespace clv::test
