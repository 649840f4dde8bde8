// Samples of surfaces stand for their area, on the sides that light can reach.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "bindings/embree/surface_order.h"
#include "bindings/embree/surface_samples.h"
#include "bindings/embree/task_pool.h"
#include "embree/small_scenes.h"

namespace clv::test {
namespace {

constexpr std::size_t kCount = 4096;

SurfaceSamples samplesOf(const Scene& scene) { return sampleSurfaces(EmbreeScene(scene), kCount, 1, tbbParallelFor(2)); }

// A box whose faces look inwards, 2 x 1 x 3 m. A sheet of 0.5 m^2 may hang in it.
Scene insideOfABox(bool withSheet = false) {
    SmallScene small;
    const auto white = small.material(glm::vec3(1.0f));
    small.rectangle({0, 0, 0}, {0, 0, 3}, {2, 0, 0}, white);
    small.rectangle({0, 1, 0}, {2, 0, 0}, {0, 0, 3}, white);
    small.rectangle({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, white);
    small.rectangle({0, 0, 3}, {0, 1, 0}, {2, 0, 0}, white);
    small.rectangle({0, 0, 0}, {0, 1, 0}, {0, 0, 3}, white);
    small.rectangle({2, 0, 0}, {0, 0, 3}, {0, 1, 0}, white);
    if (withSheet) small.triangle({0.5, 0.5, 1.0}, {1.5, 0.5, 1.0}, {1.0, 0.5, 2.0}, white);
    return small.finish();
}

TEST(SurfaceSamples, aClosedRoomIsSampledInsideOnlyAndInProportionToArea) {
    const SurfaceSamples samples = samplesOf(insideOfABox());
    EXPECT_FLOAT_EQ(samples.area, 22.0f / kCount);
    EXPECT_NEAR(double(samples.receivers.size()), double(kCount), 0.002 * kCount);
    std::size_t onFloor = 0;
    for (std::size_t i = 0; i < samples.receivers.size(); ++i) {
        const ClvReceiver& r = samples.receivers[i];
        EXPECT_GT(glm::dot(r.normal, glm::vec3(1.0f, 0.5f, 1.5f) - r.position), 0.0f);
        onFloor += r.normal.y > 0.5f;
    }
    EXPECT_NEAR(double(onFloor) * samples.area, 6.0, 2.0 * samples.area);
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
    EXPECT_NEAR(double(up) * after.area, 0.5, 2.0 * after.area);
    EXPECT_EQ(up, down);
    EXPECT_FLOAT_EQ(after.area - before.area, 0.5f / kCount);
}

TEST(SurfaceSamples, areTheSameForASeedWhateverTheThreads) {
    const Scene scene = insideOfABox();
    const auto samples = [&](int threads, uint seed) { return sampleSurfaces(EmbreeScene(scene), kCount, seed, tbbParallelFor(threads)); };
    const SurfaceSamples one = samples(1, 1), two = samples(2, 1), other = samples(2, 2);
    ASSERT_EQ(one.receivers.size(), two.receivers.size());
    for (std::size_t i = 0; i < one.receivers.size(); ++i) EXPECT_EQ(one.receivers[i].position, two.receivers[i].position);
    EXPECT_NE(one.receivers[0].position, other.receivers[0].position);
}

TEST(SurfaceOrder, hasNeighboursNearEachOther) {
    const Scene scene = insideOfABox();
    const SurfaceSamples samples = samplesOf(scene);
    std::vector<ClvRsmTexel> texels;
    for (const ClvReceiver& r : samples.receivers) texels.push_back({r.position, 0.0f, r.normal, 1u, vec3(1.0f), 0.0f});
    sortAlongSurfaces(texels, scene.bounds);
    ASSERT_EQ(texels.size(), samples.receivers.size());
    std::size_t near = 0, turns = 0;
    for (std::size_t i = 1; i < texels.size(); ++i) {
        near += glm::length(texels[i - 1].position - texels[i].position) < 3.0f * std::sqrt(samples.area);
        turns += glm::dot(texels[i - 1].normal, texels[i].normal) < 0.5f;
    }
    EXPECT_EQ(turns, 5u) << "each of six faces is left once";
    EXPECT_GT(near, texels.size() * 8 / 10);
}

}  // namespace
}  // namespace clv::test
