// A frame allocates nothing once everything has been as large as it gets.
#include <gtest/gtest.h>

#include "clv/cpu/build_level.h"
#include "clv/cpu/lookup_table.h"
#include "clv/cpu/still_lighting.h"
#include "cpu/moving_scene.h"
#include "support/allocation_count.h"

using namespace clv;
using namespace clv::test;

namespace {

std::size_t allocationsOfALap(const LitHall& hall, MovingLighting& lighting) {
    const std::size_t before = allocationCount();
    const int steps = 24;
    for (int step = 0; step < steps; ++step) {
        const double angle = 2.0 * double(kClvPi) * step / steps;
        lighting.moveTo(viewFrom(4.0 * std::cos(angle), -1.0, 3.0 * std::sin(angle)));
        hall.frame(lighting, 2000);
        const ClvReceiver receiver{vec3(3.0f * float(std::cos(angle)), -3.02f, 2.0f), 0.0f, vec3(0.0f, 1.0f, 0.0f), 0.0f};
        EXPECT_GE(lighting.irradiance(receiver).x, 0.0f);
    }
    return allocationCount() - before;
}

TEST(MovingLightingMemory, takesNothingMoreOnceItHasBeenEverywhere) {
    const LitHall hall;
    for (bool movingLights : {false, true}) {
        MovingLightingSettings settings = twoCascades();
        settings.movingLights = movingLights;
        settings.chunks = 2;
        MovingLighting lighting(settings, hall.scene.probe(), hall.tracer(), serialFor());
        // In the second lap cells come back to storage that others have left in another order.
        EXPECT_GT(allocationsOfALap(hall, lighting), 0u);
        allocationsOfALap(hall, lighting);
        EXPECT_EQ(allocationsOfALap(hall, lighting), 0u);
    }
}

TEST(StillLightingMemory, takesNothingAfterTheFirstFrame) {
    LitHall hall;
    const std::vector<ClvReceiver> receivers = floorAround(vec3(0.0f), 5.0f);
    StillLightingSettings settings;
    settings.parts = {2, 2};
    StillLighting lighting(settings, hall.tracer(), serialFor());
    std::vector<LookupTable> lookups;
    for (int resolution : {8, 16}) {
        const ClvVolume volume = volumeOverBounds(vec3(-10.0f, -3.0f, -7.0f), vec3(10.0f, 3.0f, 7.0f), resolution, kClvStorageCube9);
        Level level = buildLevel(volume, hall.scene.probe(), neededCells(volume, receivers), serialFor());
        lookups.emplace_back(level, receivers, LookupOptions{}, serialFor());
        lighting.addLevel(std::move(level));
    }
    const auto frame = [&] {
        const std::size_t before = allocationCount();
        hall.sampler.build(hall.texels, 16, serialFor());
        lighting.rays(hall.sampler, 2000);
        lighting.trace();
        lighting.inject();
        lighting.merge();
        float sum = 0.0f;
        for (std::size_t l = 0; l < lookups.size(); ++l) {
            for (std::size_t i = 0; i < receivers.size(); ++i) {
                sum += lookups[l].irradiance(i, settings.layout, lighting.volumes()[l].history(0), settings.layout.read(receivers[i].normal)).x;
            }
        }
        EXPECT_GT(sum, 0.0f);
        return allocationCount() - before;
    };
    EXPECT_GT(frame(), 0u);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(frame(), 0u) << k;
}

// Runs `work` with ever more memory until there is enough, from none at all. Returns how often there was not.
template <class Work>
std::size_t runOutOfMemory(Work&& work) {
    for (std::size_t failures = 0;; ++failures) {
        firstFailure = allocationCount() + failures + 1;
        bool enough = true;
        try {
            work();
        } catch (const std::bad_alloc&) {
            enough = false;
        }
        firstFailure = std::numeric_limits<std::size_t>::max();
        if (enough) return failures;
    }
}

// Whether it leaks is for the address sanitizer to say.
TEST(OutOfMemory, isSaidWhereverItHappensInAFrameAndTheNextFrameIsRight) {
    const LitHall hall;
    MovingLightingSettings settings = twoCascades();
    settings.cascades.resolution = ivec3(4), settings.cascades.marginCells = 0, settings.cascades.finestCellSize = 3.0, settings.linesPerCell = 1;
    settings.movingLights = true, settings.chunks = 2;
    const ClvReceiver receiver{vec3(0.5f, -3.02f, 0.5f), 0.0f, vec3(0.0f, 1.0f, 0.0f), 0.0f};
    vec3 irradiance(0.0f);
    const auto frames = [&] {
        MovingLighting lighting(settings, hall.scene.probe(), hall.tracer(), serialFor());
        for (double x : {0.0, 2.0}) {
            lighting.moveTo(viewFrom(x, 0.0, 0.0));
            hall.frame(lighting, 200);
        }
        irradiance = lighting.irradiance(receiver);
    };
    frames();
    const vec3 expected = irradiance;
    EXPECT_GT(expected.x, 0.0f);
    EXPECT_GT(runOutOfMemory(frames), 100u);
    EXPECT_EQ(irradiance, expected);
}

// What a failed move leaves can be moved again; that nothing is read beyond its end is for the address sanitizer to say.
TEST(OutOfMemory, inAMoveLeavesVolumesThatCoverNothingUntilTheNext) {
    const LitHall hall;
    MovingLightingSettings settings = twoCascades();
    settings.cascades.resolution = ivec3(4), settings.cascades.marginCells = 0, settings.cascades.finestCellSize = 3.0, settings.linesPerCell = 1;
    settings.movingLights = true;
    settings.slotsPerCell = 0.2f;  // so that arrays grow in the middle of a move
    for (std::size_t left = 0;; ++left) {
        MovingLighting lighting(settings, hall.scene.probe(), hall.tracer(), serialFor());
        lighting.moveTo(viewFrom(0.0, 0.0, 0.0));
        hall.frame(lighting, 200);
        firstFailure = allocationCount() + left + 1;
        bool enough = true;
        try {
            lighting.moveTo(viewFrom(2.0, 0.0, 0.0));
        } catch (const std::bad_alloc&) {
            enough = false;
        }
        firstFailure = std::numeric_limits<std::size_t>::max();
        for (const MovingVolume& volume : lighting.volumes()) {
            ASSERT_EQ(volume.frames().size(), volume.level().slots.size()) << left;
            ASSERT_EQ(volume.history().size(), volume.level().slots.size() * std::size_t(settings.layout.stride())) << left;
        }
        lighting.moveTo(viewFrom(6.0, 1.0, 0.0));
        hall.frame(lighting, 200);
        EXPECT_GT(meanOf(irradianceAt(lighting, floorAround(vec3(6.0f, 0.0f, 0.0f), 2.0f))).x, 0.0f) << left;
        if (enough) {
            EXPECT_GT(left, 10u);
            break;
        }
    }
}

TEST(OutOfMemory, leavesLightThatGoesOnOnceThereIsMemoryAgain) {
    const LitHall hall;
    MovingLightingSettings settings = twoCascades();
    settings.cascades.resolution = ivec3(4), settings.cascades.marginCells = 0, settings.cascades.finestCellSize = 3.0, settings.linesPerCell = 1;
    MovingLighting lighting(settings, hall.scene.probe(), hall.tracer(), serialFor());
    lighting.moveTo(viewFrom(0.0, 0.0, 0.0));
    hall.frame(lighting, 200);
    // More rays than there ever were.
    std::size_t rays = 200;
    EXPECT_GT(runOutOfMemory([&] { hall.frame(lighting, rays *= 2); }), 0u);
    EXPECT_GT(meanOf(irradianceAt(lighting, floorAround(vec3(0.0f), 2.0f))).x, 0.0f);
}

TEST(AllocationCount, countsAllocationsThatHappen) {
    const std::size_t before = allocationCount();
    AlignedFloats floats(100);
    std::vector<int> ints(100);
    EXPECT_EQ(allocationCount() - before, 2u);
    EXPECT_EQ(floats[99] + float(ints[99]), 0.0f);
}

}  // namespace
