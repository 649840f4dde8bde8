// A frame allocates nothing once everything has been as large as it gets.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "cpu/allocation_count.h"
#include "cpu/moving_scene.h"

namespace {
std::atomic<std::size_t> allocations{0};

void* allocate(std::size_t size, std::size_t alignment) {
    ++allocations;
    void* memory = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
    if (!memory) throw std::bad_alloc();
    return memory;
}
}  // namespace

void* operator new(std::size_t size) { return allocate(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) { return allocate(size, std::size_t(alignment)); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

std::size_t clv::test::allocationCount() { return allocations; }

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
