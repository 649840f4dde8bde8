// Every loop of the core over threads of its own: the same bits as on one, and nothing for the thread sanitizer to say.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "clv/clv.h"
#include "cpu/moving_scene.h"

using namespace clv;
using namespace clv::test;

namespace {

// Threads start anew for each loop and take its items in turn.
ParallelFor fourThreads() {
    return [](std::size_t count, const std::function<void(std::size_t)>& body) {
        std::atomic<std::size_t> next{0};
        std::vector<std::thread> threads;
        for (int t = 0; t < 4; ++t) {
            threads.emplace_back([&] {
                for (std::size_t i; (i = next++) < count;) body(i);
            });
        }
        for (std::thread& thread : threads) thread.join();
    };
}

std::vector<float> movingHistory(const ParallelFor& parallelFor) {
    LitHall hall;
    hall.sampler.build(hall.texels, 16, parallelFor);
    MovingLightingSettings settings = twoCascades();
    settings.movingLights = true, settings.chunks = 3, settings.linesPerCell = 2;
    MovingLighting lighting(settings, hall.scene.probe(), hall.tracer(), parallelFor);
    for (double x : {0.0, 1.3, 4.0}) {
        lighting.moveTo(viewFrom(x, 0.0, 0.0));
        hall.frame(lighting, 4000);
    }
    std::vector<float> all;
    for (const MovingVolume& volume : lighting.volumes()) all.insert(all.end(), volume.history().begin(), volume.history().end());
    // Irradiance may be asked for from several threads.
    const std::vector<ClvReceiver> receivers = floorAround(vec3(2.0f, 0.0f, 0.0f), 4.0f);
    std::vector<vec3> irradiance(receivers.size());
    parallelFor(receivers.size(), [&](std::size_t i) { irradiance[i] = lighting.irradiance(receivers[i]); });
    for (const vec3& e : irradiance) all.insert(all.end(), {e.x, e.y, e.z});
    return all;
}

std::vector<float> stillHistory(const ParallelFor& parallelFor) {
    LitHall hall;
    hall.sampler.build(hall.texels, 16, parallelFor);
    StillLightingSettings settings;
    settings.parts = {2, 3};
    const std::vector<ClvReceiver> receivers = floorAround(vec3(0.0f), 5.0f);
    StillLighting lighting(settings, hall.tracer(), parallelFor);
    const ClvVolume volume = volumeOverBounds(vec3(-10.0f, -3.0f, -7.0f), vec3(10.0f, 3.0f, 7.0f), 12, kClvStorageCube9);
    lighting.addLevel(buildLevel(volume, hall.scene.probe(), neededCells(volume, receivers), parallelFor));
    const LookupTable lookup(lighting.volumes()[0].level(), receivers, LookupOptions{}, parallelFor);
    for (int frame = 0; frame < 2; ++frame) {
        lighting.rays(hall.sampler, 4000);
        lighting.trace();
        lighting.inject();
        lighting.merge();
    }
    std::vector<float> all;
    for (int half = 0; half < 2; ++half) all.insert(all.end(), lighting.volumes()[0].history(half).begin(), lighting.volumes()[0].history(half).end());
    return all;
}

TEST(Threads, leaveMovingLightAsItIsOnOneThread) {
    const std::vector<float> expected = movingHistory(serialFor());
    EXPECT_GT(*std::max_element(expected.begin(), expected.end()), 0.0f);
    EXPECT_EQ(movingHistory(fourThreads()), expected);
}

TEST(Threads, leaveStillLightAsItIsOnOneThread) {
    const std::vector<float> expected = stillHistory(serialFor());
    EXPECT_GT(*std::max_element(expected.begin(), expected.end()), 0.0f);
    EXPECT_EQ(stillHistory(fourThreads()), expected);
}

}  // namespace
