// A grid in which no cell is open: it has nowhere to keep light, and all stages pass over it.
#include <gtest/gtest.h>

#include "clv/cpu/build_level.h"
#include "clv/cpu/moving_volume.h"
#include "clv/cpu/volume.h"
#include "cpu/moving_scene.h"

using namespace clv;
using namespace clv::test;

namespace {

// A solid whose faces lie beyond the grid of 2 m, and one whose faces lie in its outermost cells.
const BoxScene kSolids[] = {{{{vec3(0.0f), vec3(1.5f)}}}, {{{vec3(0.0f), vec3(1.0f)}}}};

ClvVolume grid() {
    ClvVolume volume{};
    volume.origin = vec3(-1.0f), volume.cellSize = 0.25f, volume.resolution = ivec3(8), volume.storage = kClvStorageCube9;
    return volume;
}

std::vector<ClvRay> raysThrough() {
    std::vector<ClvRay> rays;
    for (int k = 0; k < 64; ++k) {
        ClvRay ray{};
        ray.origin = vec3(-3.0f, -0.9f + 0.2f * float(k % 8), -0.9f + 0.2f * float(k / 8)), ray.direction = glm::normalize(vec3(1.0f, 0.01f, 0.02f));
        ray.maxDistance = 10.0f, ray.flux = vec3(1.0f), ray.dynamicity = 1.0f;
        rays.push_back(ray);
    }
    return rays;
}

std::vector<ClvReceiver> receiversInSolid() {
    std::vector<ClvReceiver> all;
    for (int k = 0; k < 27; ++k) all.push_back({0.45f * vec3(float(k % 3 - 1), float(k / 3 % 3 - 1), float(k / 9 - 1)), 0.0f, vec3(0.0f, 1.0f, 0.0f), 0.0f});
    return all;
}

TEST(SolidGrid, holdsNoSlotsAndStillLightPassesOverIt) {
    for (const BoxScene& solid : kSolids) {
        Level level = buildLevel(grid(), solid.probe(), {}, serialFor());
        EXPECT_EQ(level.slots.size(), 0u);
        const DepositLayout layout;
        Volume volume(std::move(level), layout, {.halves = 2, .chunks = 2});
        const std::vector<ClvRay> rays = raysThrough();
        for (int half : {0, 1}) {
            for (int chunk : {0, 1}) inject(volume.level(), layout, kClvInjectTrackLength, rays, volume.partial(half, chunk));
        }
        volume.merge(double(rays.size()), 1.0f / float(rays.size()), serialFor());
        EXPECT_EQ(volume.history(0).size(), 0u);
        for (const ClvReceiver& receiver : receiversInSolid()) {
            SlotWeights weights;
            lookupWeights(volume.level(), receiver, {}, weights);
            EXPECT_EQ(readIrradiance(layout, volume.history(0), weights, layout.read(receiver.normal)), vec3(0.0f));
        }
    }
}

TEST(SolidGrid, isPassedOverByMovingLightAndOpensAgainOutside) {
    const BoxScene& solid = kSolids[0];
    MovingVolume volume({.level = {.resolution = ivec3(8), .linesPerCell = 2}, .movingLights = true});
    const auto goTo = [&](int x) { volume.moveTo({.lowest = LatticeCell(x - 4, -4, -4), .resolution = ivec3(8), .cellSize = 0.25}, nullptr, solid.probe(), serialFor()); };
    const std::vector<ClvRay> rays = raysThrough();
    const auto frame = [&] {
        inject(volume.level(), {}, kClvInjectTrackLength, rays, volume.partial(0));
        volume.merge(1.0f / float(rays.size()), {1.0f / 60.0f, 10.0f, 0.1f, 0.5f}, serialFor());
    };
    goTo(0);
    frame();
    EXPECT_EQ(volume.level().slots.size(), 0u);
    for (const ClvReceiver& receiver : receiversInSolid()) EXPECT_EQ(volume.irradiance(receiver, {}), vec3(0.0f));
    goTo(-10);  // half outside
    frame();
    EXPECT_GT(volume.level().slots.size(), 0u);
    EXPECT_GT(volume.irradiance({vec3(-2.0f, 0.0f, 0.0f), 0.0f, vec3(-1.0f, 0.0f, 0.0f), 0.0f}, {}).x, 0.0f);
    goTo(0);
    frame();
    for (const ClvReceiver& receiver : receiversInSolid()) EXPECT_EQ(volume.irradiance(receiver, {}), vec3(0.0f));
}

}  // namespace
