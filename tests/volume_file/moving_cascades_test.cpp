// Light that follows a camera, kept at one moment.
#include "bindings/volume_file/moving_cascades.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "bindings/volume_file/level_check.h"
#include "cpu/moving_scene.h"

using namespace clv;
using namespace clv::test;

namespace {

// After some steps through the hall, one of them large, so that storage is scrolled and slots have been given back.
struct Walk {
    LitHall hall;
    MovingLighting lighting;
    BakedVolume kept;

    explicit Walk(bool movingLights)
        : lighting([&] {
              MovingLightingSettings settings = twoCascades();
              settings.movingLights = movingLights;
              settings.guessFrames = settings.slidOutFrames = 0.0f;
              return settings;
          }(), hall.scene.probe(), hall.tracer(), serialFor()) {
        hall.light(litPatches(1.0f, movingLights ? 0.5f : 0.0f));
        for (const double x : {-4.0, -3.2, 1.1, 0.3}) {
            lighting.moveTo(viewFrom(x, -1.2, 0.7));
            hall.frame(lighting, 2000);
        }
        keepCascades(lighting, 2000.0, kept);
    }
};

TEST(MovingCascades, areReadAsTheyWereWhileTheyMoved) {
    const Walk walk(true);
    ASSERT_EQ(walk.kept.cascades.size(), 2u);
    EXPECT_NE(walk.lighting.cascades().volumes[0].scroll, ivec3(0));
    int lit = 0;
    for (const ClvReceiver& receiver : floorAround(vec3(0.3f, 0.0f, 0.7f), 9.0f)) {
        const vec3 expected = walk.lighting.irradiance(receiver);
        EXPECT_EQ(irradianceAt(walk.kept, receiver), expected);
        lit += expected.x > 0.0f ? 1 : 0;
    }
    EXPECT_GT(lit, 50);
}

TEST(MovingCascades, keepTablesThatHoldTogetherWithoutGaps) {
    const Walk walk(false);
    for (std::size_t k = 0; k < 2; ++k) {
        const BakedCascade& cascade = walk.kept.cascades[k];
        EXPECT_EQ(problemOf(cascade.level), "");
        EXPECT_EQ(cascade.level.volume.scroll, ivec3(0));
        EXPECT_LT(cascade.level.slots.size(), walk.lighting.volumes()[k].level().slots.size());
        EXPECT_FALSE(cascade.level.splits.empty());
        EXPECT_TRUE(std::ranges::is_sorted(cascade.level.slots, {}, &ClvSlot::cell));
        EXPECT_TRUE(cascade.dynamicity.empty()) << "no light moves";
    }
}

TEST(MovingCascades, samplesCountTheFramesThatASlotHasSeen) {
    const Walk walk(false);
    const auto [fewest, most] = std::ranges::minmax(walk.kept.cascades[0].samples);
    EXPECT_FLOAT_EQ(fewest, 2000.0f) << "cells that came into view in the last of four frames";
    EXPECT_FLOAT_EQ(most, 8000.0f);
}

TEST(MovingCascades, dynamicityIsThatOfTheLightThatReachesASide) {
    const Walk walk(true);
    const auto& dynamicity = walk.kept.cascades[0].dynamicity;
    ASSERT_EQ(dynamicity.size(), walk.kept.cascades[0].level.slots.size() * kSides);
    EXPECT_NEAR(*std::ranges::max_element(dynamicity), 0.5f, 1e-6f);
    float brightest = 0.0f;
    for (std::size_t cell = 0; cell < walk.kept.cascades[0].level.cellCount(); ++cell) {
        for (const float side : cellLight(walk.kept, walk.kept.cascades[0], cell).dynamicity) brightest = std::max(brightest, side);
    }
    EXPECT_NEAR(brightest, 0.5f, 1e-6f);
}

}  // namespace
