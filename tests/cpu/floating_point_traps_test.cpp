// The core runs where an engine has floating-point traps switched on: no number of a frame is invalid, divided by zero or too large.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>

#include "bindings/cli/stress/walk_rays.h"
#include "clv/clv.h"
#include "cpu/moving_scene.h"
#include "support/floating_point_traps.h"

using namespace clv;
using namespace clv::test;

namespace {

TEST(FloatingPointTraps, areSprungByAFault) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    volatile float zero = 0.0f;
    EXPECT_EXIT(
        {
            std::signal(SIGFPE, SIG_DFL);  // a sanitizer would answer it by an exit of its own
            const FloatingPointTraps traps;
            zero = 1.0f / zero;
        },
        testing::KilledBySignal(SIGFPE), "");
}

TEST(FloatingPointTraps, areNotSprungByFramesAroundAMovingCamera) {
    const LitHall hall;
    for (uint storage : {kClvStorageCube, kClvStorageCube9, kClvStorageSh1, kClvStorageSh2}) {
        MovingLightingSettings settings = twoCascades();
        settings.layout.storage = storage, settings.movingLights = storage % 2 == 0;
        const FloatingPointTraps traps;
        MovingLighting lighting(settings, hall.scene.probe(), hall.tracer(), serialFor());
        for (int step = 0; step < 4; ++step) {
            lighting.moveTo(viewFrom(1.3 * step, 0.0, -0.7 * step));
            hall.frame(lighting, 2000);
        }
        EXPECT_GT(meanOf(irradianceAt(lighting, floorAround(vec3(0.0f), 3.0f))).x, 0.0f);
    }
}

TEST(FloatingPointTraps, areNotSprungByStillLightAndItsGuide) {
    LitHall hall;
    StillLightingSettings settings;
    settings.parts = {2, 1};
    const std::vector<ClvReceiver> receivers = floorAround(vec3(0.0f), 5.0f);
    const FloatingPointTraps traps;
    StillLighting lighting(settings, hall.tracer(), serialFor());
    const ClvVolume volume = volumeOverBounds(vec3(-10.0f, -3.0f, -7.0f), vec3(10.0f, 3.0f, 7.0f), 12, kClvStorageCube9);
    lighting.addLevel(buildLevel(volume, hall.scene.probe(), neededCells(volume, receivers), serialFor()));
    const LookupTable lookup(lighting.volumes()[0].level(), receivers, LookupOptions{}, serialFor());
    for (int frame = 0; frame < 2; ++frame) {
        hall.light(litPatches());
        lighting.rays(hall.sampler, 4000);
        lighting.trace();
        lighting.inject();
        lighting.merge();
    }
    float sum = 0.0f;
    for (std::size_t i = 0; i < receivers.size(); ++i) sum += lookup.irradiance(i, settings.layout, lighting.volumes()[0].history(0), settings.layout.read(receivers[i].normal)).x;
    EXPECT_GT(sum, 0.0f);
}

TEST(FloatingPointTraps, areNotSprungByRaysOfAnyKind) {
    ClvVolume volume{};
    volume.origin = vec3(-3.1f, 0.7f, -9.2f), volume.cellSize = 0.37f, volume.resolution = ivec3(33, 17, 25), volume.storage = kClvStorageCube9;
    const Level level = buildLevel(volume, {}, {}, serialFor(), {.linesPerCell = 0, .findRegions = false});
    const DepositLayout layout;
    Random random(5);
    std::vector<ClvRay> rays;
    for (int k = 0; k < 20000; ++k) rays.push_back(rayOfKind(RayKind(k % int(RayKind::kCount)), random, volume));
    PartialVolume partial;
    partial.resize(level.slots.size(), layout, false);
    const FloatingPointTraps traps;
    inject(level, layout, kClvInjectTrackLength, rays, partial.target());
    inject(level, layout, kClvInjectThesis, rays, partial.target());
    CrossingBuffer buffer;
    float length = 0.0f;
    const auto flush = [&](CrossingBuffer& crossings) {
        for (int k = 0; k < crossings.count; ++k) length += crossings.weight[k];
        crossings.count = 0;
    };
    walkPacketPortable(level, kClvInjectTrackLength, std::span(rays).first(kPacketLanes), buffer, flush);
    flush(buffer);
    EXPECT_GT(length, 0.0f);
}

TEST(FloatingPointTraps, areNotSprungByRaysThatAreDeadOrAsBrightAsFloatsOrWhoseFluxIsNoNumber) {
    for (float cellSize : {1e-9f, 0.37f, 1e5f}) {
        for (uint storage : {kClvStorageCube, kClvStorageCube9, kClvStorageSh1, kClvStorageSh2}) {
            ClvVolume volume{};
            volume.origin = vec3(-4.0f * cellSize), volume.cellSize = cellSize, volume.resolution = ivec3(8), volume.storage = storage;
            const Level level = buildLevel(volume, {}, {}, serialFor(), {.linesPerCell = 0, .findRegions = false});
            const DepositLayout layout{storage, 3};
            Random random(7);
            std::vector<ClvRay> rays;
            for (int k = 0; k < 2000; ++k) {
                ClvRay ray = rayOfKind(RayKind::kAnywhere, random, volume);
                switch (k % 7) {
                    case 0: ray.flux = vec3(3e38f); break;
                    case 1: ray = clvDeadRay(); break;
                    case 2: ray.flux.y = std::nanf(""); break;
                    case 3: ray.flux.z = HUGE_VALF; break;
                    case 4: ray.flux.x = -HUGE_VALF; break;
                    case 5: ray.maxDistance = HUGE_VALF; break;
                    case 6: ray.direction = vec3(0.0f); break;
                }
                rays.push_back(ray);
            }
            PartialVolume partial;
            partial.resize(level.slots.size(), layout, false);
            {
                const FloatingPointTraps traps;
                inject(level, layout, kClvInjectTrackLength, rays, partial.target());
                inject(level, layout, kClvInjectThesis, rays, partial.target());
            }
            EXPECT_TRUE(std::ranges::all_of(partial.deposits, [](float deposit) { return clvIsFinite(deposit); }));
            EXPECT_GT(std::ranges::max(partial.deposits), 0.0f);
        }
    }
}

TEST(FloatingPointTraps, areNotSprungByACameraThatJumpsAMillionCells) {
    const LitHall hall;
    MovingLightingSettings settings = twoCascades();
    settings.cascades.resolution = ivec3(8), settings.cascades.marginCells = 1, settings.movingLights = true;
    const FloatingPointTraps traps;
    MovingLighting lighting(settings, hall.scene.probe(), hall.tracer(), serialFor());
    for (double cells : {0.0, 1e6, 0.0, -1e6, 4e6, 0.0}) {
        lighting.moveTo(viewFrom(0.5 * cells, 0.0, 0.0));
        for (float timestep : {1e-4f, 1.0f / 60.0f, 1e3f}) {
            lighting.rays(hall.sampler, 500);
            lighting.trace();
            lighting.inject();
            lighting.merge(timestep);
        }
    }
    EXPECT_GT(meanOf(irradianceAt(lighting, floorAround(vec3(0.0f), 3.0f))).x, 0.0f);
}

}  // namespace
