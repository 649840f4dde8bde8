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

// Runs `work` with memory for so many allocations. Returns whether it was too little.
template <class Work>
bool failsAt(std::size_t allocations, Work&& work) {
    firstFailure = allocationCount() + allocations + 1;
    bool failed = false;
    try {
        work();
    } catch (const std::bad_alloc&) {
        failed = true;
    }
    firstFailure = std::numeric_limits<std::size_t>::max();
    return failed;
}

// The same with ever more memory until there is enough, from none at all. Returns how often there was not.
template <class Work>
std::size_t runOutOfMemory(Work&& work) {
    for (std::size_t failures = 0;; ++failures) {
        if (!failsAt(failures, work)) return failures;
    }
}

MovingLightingSettings smallCascades() {
    MovingLightingSettings settings = twoCascades();
    settings.cascades.resolution = ivec3(4), settings.cascades.marginCells = 0, settings.cascades.finestCellSize = 3.0, settings.linesPerCell = 1;
    settings.movingLights = true, settings.chunks = 2;
    return settings;
}

// Frames of a moving light that can be broken off; `drawn` counts those whose rays were drawn, for the next frame's are others.
struct BrokenFrames {
    const LitHall& hall;
    MovingLighting lighting;
    int drawn = 0;

    BrokenFrames(const LitHall& lit, const MovingLightingSettings& settings) : hall(lit), lighting(settings, lit.scene.probe(), lit.tracer(), serialFor()) {}
    void frame(double x) {
        lighting.moveTo(viewFrom(x, 0.0, 0.0));
        lighting.rays(hall.sampler, 200);
        ++drawn;
        lighting.trace();
        lighting.inject();
        lighting.merge(1.0f / 60.0f);
    }
    std::vector<vec3> light() const { return irradianceAt(lighting, floorAround(vec3(2.0f, 0.0f, 0.0f), 4.0f)); }
};

// Whether it leaks is for the address sanitizer to say.
TEST(OutOfMemory, isSaidWhereverItHappensInAFrameAndTheNextFrameIsRight) {
    const LitHall hall;
    const MovingLightingSettings settings = smallCascades();
    // What an object gives that nothing ever happened to, after as many frames were drawn.
    std::vector<std::vector<vec3>> expected;
    for (int drawn = 0; drawn <= 2; ++drawn) {
        BrokenFrames fresh(hall, settings);
        for (int k = 0; k < drawn; ++k) fresh.lighting.rays(hall.sampler, 200);
        fresh.frame(2.0);
        expected.push_back(fresh.light());
        EXPECT_GT(meanOf(expected.back()).x, 0.0f);
    }
    EXPECT_NE(expected[0], expected[1]);
    std::size_t failures = 0;
    for (bool enough = false; !enough; failures += !enough) {
        BrokenFrames broken(hall, settings);
        enough = !failsAt(failures, [&] {
            for (double x : {0.0, 2.0}) broken.frame(x);
        });
        broken.lighting.reset();
        const int drawn = broken.drawn;
        broken.frame(2.0);
        ASSERT_EQ(broken.light(), expected[std::size_t(drawn)]) << "memory for " << failures << " allocations, " << drawn << " frames drawn";
    }
    EXPECT_GT(failures, 100u);
}

// Levels are made ahead, as they are in use; what a frame takes are its rays.
TEST(OutOfMemory, isSaidInAFrameOfStillLightAndTheNextFrameIsRight) {
    const LitHall hall;
    StillLightingSettings settings;
    settings.parts = {2, 2};
    const ClvVolume place = volumeOverBounds(vec3(-10.0f, -3.0f, -7.0f), vec3(10.0f, 3.0f, 7.0f), 6, kClvStorageCube9);
    const auto frame = [&](StillLighting& lighting, std::size_t rays, int* drawn) {
        lighting.rays(hall.sampler, rays);
        ++*drawn;
        lighting.trace();
        lighting.inject();
        lighting.merge();
    };
    const auto make = [&] {
        auto lighting = std::make_unique<StillLighting>(settings, hall.tracer(), serialFor());
        lighting->addLevel(buildLevel(place, hall.scene.probe(), {}, serialFor()));
        return lighting;
    };
    const auto historyOf = [](const StillLighting& lighting) {
        const std::span<const float> history = lighting.volumes()[0].history(0);
        return std::vector<float>(history.begin(), history.end());
    };
    std::size_t failures = 0;
    for (bool enough = false; !enough; failures += !enough) {
        const auto broken = make(), fresh = make();
        int drawn = 0, ignored = 0;
        enough = !failsAt(failures, [&] { frame(*broken, 400, &drawn); });
        broken->volumes()[0].reset();
        for (int k = 0; k < drawn; ++k) fresh->rays(hall.sampler, 400);
        frame(*broken, 400, &ignored), frame(*fresh, 400, &ignored);
        const std::vector<float> history = historyOf(*broken);
        ASSERT_EQ(history, historyOf(*fresh)) << failures;
        EXPECT_NE(history, std::vector<float>(history.size(), 0.0f));
    }
    EXPECT_GT(failures, 0u);
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
