// Light that follows a camera through a hall.
#include <gtest/gtest.h>

#include <limits>
#include <thread>

#include "cpu/moving_scene.h"

using namespace clv;
using namespace clv::test;

namespace {

TEST(MovingLighting, convergesToAStillVolumeAfterTheCameraStops) {
    const LitHall hall;
    MovingLighting lighting(twoCascades(), hall.scene.probe(), hall.tracer(), serialFor());
    const std::size_t rays = 4000;
    for (int step = 0; step <= 40; ++step) {
        lighting.moveTo(viewFrom(-6.0 + 0.15 * step, -1.5, 1.0));
        hall.frame(lighting, rays);
    }
    const std::array<std::vector<ClvReceiver>, 2> receivers{floorAround(vec3(0.0f, 0.0f, 1.0f), 3.0f),   // in the finest cascade
                                                            floorAround(vec3(6.5f, 0.0f, 1.0f), 1.2f)};  // only in the next one
    std::array<std::vector<vec3>, 2> truth, onArrival;
    for (int c = 0; c < 2; ++c) {
        for (const ClvReceiver& receiver : receivers[c]) {
            ASSERT_EQ(clvCascadeFromPosition(lighting.cascades(), receiver.position), uint(c));
            ASSERT_EQ(clvCascadeWeight(lighting.cascades(), uint(c), receiver.position), 1.0f);
        }
        truth[c] = stillIrradiance(hall, lighting, c, receivers[c], 1000000, 17);
        onArrival[c] = irradianceAt(lighting, receivers[c]);
    }
    const int frames = 60;
    for (int frame = 0; frame < frames; ++frame) {
        lighting.moveTo(viewFrom(0.0, -1.5, 1.0));
        hall.frame(lighting, rays);
    }
    for (int c = 0; c < 2; ++c) {
        const double moved = relativeError(irradianceAt(lighting, receivers[c]), truth[c]);
        const double still = relativeError(stillIrradiance(hall, lighting, c, receivers[c], frames * rays, 5), truth[c]);
        EXPECT_GT(meanOf(truth[c]).x, 0.0f);
        EXPECT_LT(moved, relativeError(onArrival[c], truth[c]));
        // Cells have at least as many rays as the still volume's; what is left of their first guesses may cost a little.
        EXPECT_LT(moved, 1.1 * still);
    }
}

// Frames until 90 % of a step in the light shows, or `most`.
int framesToFollow(bool movingLights, int most) {
    LitHall hall;
    MovingLightingSettings settings = twoCascades();
    settings.movingLights = movingLights;
    MovingLighting lighting(settings, hall.scene.probe(), hall.tracer(), serialFor());
    lighting.moveTo(viewFrom(-4.0, -1.5, 0.0));
    const auto receivers = floorAround(vec3(-6.0f, 0.0f, 0.0f), 1.5f);
    for (int frame = 0; frame < 60; ++frame) hall.frame(lighting, 8000);
    const float before = meanOf(irradianceAt(lighting, receivers)).x;

    ClvLight lamp{};
    lamp.intensity = vec3(1.0f);
    ClvLight brighter = lamp;
    brighter.intensity = vec3(4.0f);
    const ClvMovementScales scales{.distance = 1.0f, .angle = 0.1f, .change = 0.5f, .pad0 = 0.0f};
    EXPECT_EQ(clvLightDynamicity(lamp, brighter, scales), 1.0f);
    EXPECT_EQ(clvLightDynamicity(brighter, brighter, scales), 0.0f);

    // Nearly all the light comes from the wall: the step multiplies it by about four.
    LitHall after;
    after.light(litPatches(4.0f));
    MovingLighting settled(settings, hall.scene.probe(), hall.tracer(), serialFor());
    settled.moveTo(viewFrom(-4.0, -1.5, 0.0));
    for (int frame = 0; frame < 60; ++frame) after.frame(settled, 8000);
    const float target = meanOf(irradianceAt(settled, receivers)).x;
    EXPECT_GT(target, 3.0f * before);

    for (int frame = 1; frame <= most; ++frame) {
        hall.light(litPatches(4.0f, frame == 1 ? clvLightDynamicity(lamp, brighter, scales) : 0.0f));
        hall.frame(lighting, 8000);
        if (meanOf(irradianceAt(lighting, receivers)).x - before >= 0.9f * (target - before)) return frame;
    }
    return most;
}

TEST(MovingLighting, followsAStepInTheLightWhereDynamicityIsKept) {
    // History decays by exp(-1/3) a frame at dynamicity 1: 7 frames to a tenth of the step, a little more as dynamicity wears off.
    const int frames = framesToFollow(true, 40);
    EXPECT_LE(frames, 10);
    EXPECT_EQ(framesToFollow(false, 40), 40);
}

TEST(MovingLighting, isContinuousAcrossCascadesAndBeyondTheLast) {
    const LitHall hall;
    MovingLightingSettings settings = twoCascades();
    settings.cascades.resolution = ivec3(12, 12, 12);
    MovingLighting lighting(settings, hall.scene.probe(), hall.tracer(), serialFor());
    lighting.moveTo(viewFrom(-4.0, 0.0, 4.0));
    for (int frame = 0; frame < 50; ++frame) hall.frame(lighting, 20000);
    // From the heart of the finest cascade (to x = -1) through the last one (to x = 2) and beyond.
    std::vector<vec3> values;
    const float step = 0.01f;
    for (float x = -4.0f; x < 8.0f; x += step) values.push_back(lighting.irradiance({vec3(x, 0.1f, 4.0f), 0.0f, vec3(0.0f, 1.0f, 0.0f), 0.0f}));
    const float mean = meanOf(values).x;
    ASSERT_GT(mean, 0.0f);
    float largest = 0.0f;
    for (std::size_t i = 1; i < values.size(); ++i) largest = std::max(largest, std::abs(values[i].x - values[i - 1].x));
    EXPECT_LT(largest, 0.01f * mean);
    const ClvReceiver far{vec3(7.0f, 0.1f, 4.0f), 0.0f, vec3(0.0f, 1.0f, 0.0f), 0.0f};
    ClvReceiver atEdge = far;
    atEdge.position = clvClampToVolume(lighting.cascades().volumes[1], far.position);
    EXPECT_LT(atEdge.position.x, 2.5f);
    EXPECT_EQ(lighting.irradiance(far), lighting.irradiance(atEdge));
    EXPECT_GT(lighting.irradiance(far).x, 0.0f);
}

TEST(MovingLighting, cullsRaysWithoutAnyEffectOnWhatIsInjected) {
    const LitHall hall;
    MovingLightingSettings settings = twoCascades();
    settings.cascades.count = 1;
    settings.cascades.resolution = ivec3(12);
    MovingLighting lighting(settings, hall.scene.probe(), hall.tracer(), serialFor());
    lighting.moveTo(viewFrom(6.0, 0.0, -3.0));
    const MovingVolume& volume = lighting.volumes()[0];
    FrameRays all({.halves = 1, .chunks = 1}, settings.seed, settings.originOffset);
    all.draw(hall.sampler, 20000, serialFor());
    FrameRays fewer = all;
    fewer.cull({&volume.level().volume, 1}, serialFor());
    const auto dead = std::count_if(fewer.all().begin(), fewer.all().end(), [](const ClvRay& ray) { return ray.maxDistance == 0.0f; });
    EXPECT_GT(dead, 5000);
    EXPECT_LT(dead, 19000);
    lighting.rays(hall.sampler, 20000);
    EXPECT_TRUE(std::equal(fewer.all().begin(), fewer.all().end(), lighting.currentRays().begin(),
                           [](const ClvRay& a, const ClvRay& b) { return a.maxDistance == b.maxDistance && a.flux == b.flux; }));
    all.trace(hall.tracer(), serialFor());
    fewer.trace(hall.tracer(), serialFor());
    const DepositLayout layout;
    AlignedFloats expected(volume.level().slots.size() * layout.stride()), culled(expected.size());
    inject(volume.level(), layout, kClvInjectTrackLength, all.all(), {expected, {}});
    inject(volume.level(), layout, kClvInjectTrackLength, fewer.all(), {culled, {}});
    EXPECT_EQ(expected, culled);
    EXPECT_GT(*std::max_element(expected.begin(), expected.end()), 0.0f);
}

TEST(MovingLighting, isTheSameToTheLastBitWhateverTheThreads) {
    const LitHall hall;
    const ParallelFor threaded = [](std::size_t count, const std::function<void(std::size_t)>& body) {
        std::vector<std::thread> threads;
        for (std::size_t t = 0; t < 3; ++t) {
            threads.emplace_back([&, t] {
                for (std::size_t i = count; i-- > 0;) {
                    if (i % 3 == t) body(i);
                }
            });
        }
        for (std::thread& thread : threads) thread.join();
    };
    MovingLightingSettings settings = twoCascades();
    settings.chunks = 4;
    settings.movingLights = true;
    MovingLighting a(settings, hall.scene.probe(), hall.tracer(), serialFor()), b(settings, hall.scene.probe(), hall.tracer(), threaded);
    for (int step = 0; step < 6; ++step) {
        for (MovingLighting* lighting : {&a, &b}) {
            lighting->moveTo(viewFrom(-3.0 + 0.7 * step, -1.0, 0.4 * step));
            hall.frame(*lighting, 3000);
        }
    }
    for (std::size_t c = 0; c < 2; ++c) {
        const auto x = a.volumes()[c].history(), y = b.volumes()[c].history();
        ASSERT_EQ(x.size(), y.size());
        EXPECT_GT(*std::max_element(x.begin(), x.end()), 0.0f);
        EXPECT_TRUE(std::equal(x.begin(), x.end(), y.begin()));
    }
}

TEST(MovingLighting, isTheSameToTheLastBitAThousandKilometresFromTheOrigin) {
    const LitHall hall;
    MovingLightingSettings near = twoCascades(), far = near;
    // A whole number of times the size of both cascades, so that cells lie in the same places in memory.
    far.anchor = {1e6, -1.6e6, 2e6};
    MovingLighting a(near, hall.scene.probe(), hall.tracer(), serialFor()), b(far, hall.scene.probe(), hall.tracer(), serialFor());
    for (int step = 0; step < 4; ++step) {
        const CameraView view = viewFrom(-3.0 + 0.7 * step, -1.0, 0.4 * step);
        CameraView farView = view;
        farView.position += far.anchor;
        a.moveTo(view);
        b.moveTo(farView);
        hall.frame(a, 3000);
        hall.frame(b, 3000);
    }
    const auto receivers = floorAround(vec3(-2.0f, 0.0f, 0.0f), 3.0f);
    EXPECT_GT(meanOf(irradianceAt(a, receivers)).x, 0.0f);
    EXPECT_EQ(irradianceAt(a, receivers), irradianceAt(b, receivers));
}

TEST(MovingLighting, isDarkBeforeItsFirstMove) {
    const LitHall hall;
    MovingLighting lighting(twoCascades(), hall.scene.probe(), hall.tracer(), serialFor());
    hall.frame(lighting, 1000);
    EXPECT_EQ(meanOf(irradianceAt(lighting, floorAround(vec3(0.0f), 3.0f))), vec3(0.0f));
    lighting.moveTo(viewFrom(-4.0, -1.0, 0.0));
    hall.frame(lighting, 5000);
    EXPECT_GT(meanOf(irradianceAt(lighting, floorAround(vec3(-4.0f, 0.0f, 0.0f), 2.0f))).x, 0.0f);
}

TEST(MovingLighting, framesWithoutRaysAndStepsOfTimeThatCannotBeHarmNothing) {
    const LitHall hall;
    MovingLightingSettings settings = twoCascades();
    settings.movingLights = true, settings.merge.stillTime = 10.0f;
    MovingLighting lighting(settings, hall.scene.probe(), hall.tracer(), serialFor());
    lighting.moveTo(viewFrom(-4.0, -1.0, 0.0));
    const auto receivers = floorAround(vec3(-4.0f, 0.0f, 0.0f), 2.0f);
    hall.frame(lighting, 5000);
    const auto before = irradianceAt(lighting, receivers);
    hall.frame(lighting, 0);
    EXPECT_EQ(irradianceAt(lighting, receivers), before);
    for (float timestep : {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), std::numeric_limits<float>::max()}) {
        hall.frame(lighting, 5000, timestep);
        for (const MovingVolume& volume : lighting.volumes()) {
            for (float deposit : volume.history()) ASSERT_TRUE(clvIsFinite(deposit)) << timestep;
            for (float frames : volume.frames()) ASSERT_TRUE(frames >= 1.0f && frames <= 7.0f) << timestep;
        }
    }
}

TEST(MovingLighting, forgetsAllLightOnReset) {
    const LitHall hall;
    MovingLighting used(twoCascades(), hall.scene.probe(), hall.tracer(), serialFor());
    used.moveTo(viewFrom(-4.0, -1.0, 0.0));
    hall.frame(used, 5000);
    const auto receivers = floorAround(vec3(-4.0f, 0.0f, 0.0f), 2.0f);
    EXPECT_GT(meanOf(irradianceAt(used, receivers)).x, 0.0f);
    used.reset();
    EXPECT_EQ(meanOf(irradianceAt(used, receivers)), vec3(0.0f));
    hall.frame(used, 5000);
    for (float frames : used.volumes()[0].frames()) EXPECT_EQ(frames, 1.0f);
}

TEST(MovingLighting, statesItsMemoryBeforeItTakesIt) {
    const LitHall hall;
    for (bool movingLights : {false, true}) {
        MovingLightingSettings settings = twoCascades();
        settings.movingLights = movingLights;
        settings.slotsPerCell = 2.5f;
        settings.chunks = 2;
        MovingLighting lighting(settings, hall.scene.probe(), hall.tracer(), serialFor());
        EXPECT_EQ(lighting.bytes(), MovingLighting::bytes(settings));
        for (int step = 0; step < 4; ++step) {
            lighting.moveTo(viewFrom(step, -1.0, 0.0));
            hall.frame(lighting, 1000);
        }
        EXPECT_EQ(lighting.bytes(), MovingLighting::bytes(settings));
    }
}

TEST(MovingLighting, keepsNoDynamicityWhereLightsStandStill) {
    MovingLightingSettings still = twoCascades(), moving = still;
    moving.movingLights = true;
    const LitHall hall;
    MovingLighting lighting(still, hall.scene.probe(), hall.tracer(), serialFor());
    EXPECT_LT(MovingLighting::bytes(still), MovingLighting::bytes(moving));
    lighting.moveTo(viewFrom(0.0, 0.0, 0.0));
    EXPECT_EQ(lighting.bytes(), MovingLighting::bytes(still));
}

TEST(MovingLighting, saysWhatIsWrongWithItsSettings) {
    EXPECT_EQ(validate(MovingLightingSettings{}), "");
    MovingLightingSettings bad;
    bad.chunks = 0;
    EXPECT_NE(validate(bad), "");
    bad = {};
    bad.cascades.count = 0;
    EXPECT_NE(validate(bad), "");
    bad = {};
    bad.merge.movingTime = -1.0f;
    EXPECT_NE(validate(bad), "");
    bad = {};
    bad.newCellDynamicity = std::nanf("");
    EXPECT_NE(validate(bad), "");
}

}  // namespace
