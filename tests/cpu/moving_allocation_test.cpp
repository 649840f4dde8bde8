// A frame allocates nothing once everything has been as large as it gets.
#include <gtest/gtest.h>

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

TEST(MovingLightingMemory, countsAllocationsThatHappen) {
    const std::size_t before = allocationCount();
    AlignedFloats floats(100);
    std::vector<int> ints(100);
    EXPECT_EQ(allocationCount() - before, 2u);
    EXPECT_EQ(floats[99] + float(ints[99]), 0.0f);
}

}  // namespace
