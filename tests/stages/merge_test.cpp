#include "clv/stages/merge.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/chi_square.h"

using namespace clv;

namespace {

const float kNan = std::numeric_limits<float>::quiet_NaN();
const float kInfinity = std::numeric_limits<float>::infinity();

ClvMergeSettings settingsOf(float timestep) {
    return {.timestep = timestep, .stillTime = kClvFar, .movingTime = 0.1f, .dynamicityTime = 0.5f};
}

ClvLight spot() {
    ClvLight light{};
    light.type = kClvLightSpot;
    light.direction = vec3(0.0f, -1.0f, 0.0f);
    light.intensity = vec3(10.0f, 20.0f, 5.0f);
    light.innerConeAngle = 0.3f;
    light.outerConeAngle = 0.6f;
    return light;
}

const ClvMovementScales kScales{.distance = 0.5f, .angle = 0.2f, .change = 1.0f, .pad0 = 0.0f};

vec3 turned(float angle) { return vec3(std::sin(angle), -std::cos(angle), 0.0f); }

TEST(MergeAlpha, growsWithDynamicityFromTheStillToTheMovingRate) {
    ClvMergeSettings settings = settingsOf(1.0f / 60.0f);
    settings.stillTime = 10.0f;
    EXPECT_FLOAT_EQ(clvMergeAlpha(settings, 0.0f), -std::expm1(-1.0f / 600.0f));
    EXPECT_FLOAT_EQ(clvMergeAlpha(settings, 1.0f), -std::expm1(-1.0f / 6.0f));
    float last = 0.0f;
    for (float dynamicity = 0.0f; dynamicity <= 1.0f; dynamicity += 0.05f) {
        float alpha = clvMergeAlpha(settings, dynamicity);
        EXPECT_GT(alpha, last);
        last = alpha;
    }
    EXPECT_EQ(clvMergeAlpha(settings, 7.0f), clvMergeAlpha(settings, 1.0f));
    EXPECT_EQ(clvMergeAlpha(settings, -1.0f), clvMergeAlpha(settings, 0.0f));
}

TEST(MergeAlpha, keepsItsDigitsHoweverShortTheStep) {
    for (double x = 1e-12; x < 20.0; x *= 1.07) {
        const float rate = 0.37f, timestep = float(x) / rate;
        const double exact = -std::expm1(-double(timestep) * double(rate));
        ASSERT_NEAR(clvDecayed(timestep, rate) / exact, 1.0, 4e-7) << x;
    }
    EXPECT_EQ(clvDecayed(0.0f, 5.0f), 0.0f);
    EXPECT_EQ(clvDecayed(kInfinity, 5.0f), 1.0f);
    EXPECT_EQ(clvDecayed(kInfinity, 0.0f), 0.0f);
    EXPECT_EQ(clvDecayed(-1.0f, 5.0f), 0.0f);
    EXPECT_EQ(clvDecayed(kNan, 5.0f), 0.0f);
}

TEST(MergeAlpha, doesNotDependOnTheFrameRate) {
    for (float dynamicity : {0.1f, 0.5f, 1.0f}) {
        float whole = 1.0f - clvMergeAlpha(settingsOf(0.04f), dynamicity), half = 1.0f - clvMergeAlpha(settingsOf(0.02f), dynamicity);
        EXPECT_NEAR(half * half, whole, 1e-6f);
    }
}

TEST(MergeAlpha, aLongStallForgetsEverythingThatMoved) {
    EXPECT_EQ(clvMergeAlpha(settingsOf(1e6f), 1.0f), 1.0f);
    EXPECT_EQ(clvMergeAlpha(settingsOf(1e6f), 0.0f), 0.0f);
}

TEST(MergeWeight, stillLightIsThePlainMeanOfItsFrames) {
    ClvMergeSettings settings = settingsOf(0.016f);
    float history = 1e9f, frames = 1.0f;  // what lies there before the first frame must not matter
    double sum = 0.0;
    for (uint n = 1; n <= 1000; ++n) {
        float current = test::randomUnit(1u, n), weight = clvMergeWeight(settings, 0.0f, frames);
        history = clvMergeValue(history, current, weight);
        frames = clvFramesFromWeight(weight) + 1.0f;
        sum += current;
        ASSERT_NEAR(history, sum / n, 1e-4);
    }
    EXPECT_NEAR(frames, 1001.0f, 0.1f);
}

TEST(MergeWeight, movingLightIsTheExponentialMeanOnceItHasEnoughFrames) {
    ClvMergeSettings settings = settingsOf(0.016f);
    float alpha = clvMergeAlpha(settings, 1.0f);
    EXPECT_EQ(clvMergeWeight(settings, 1.0f, 1.0f), 1.0f);
    EXPECT_EQ(clvMergeWeight(settings, 1.0f, 2.0f), 0.5f);
    EXPECT_EQ(clvMergeWeight(settings, 1.0f, 1000.0f), alpha);
    EXPECT_EQ(clvMergeWeight(settings, 1.0f, 0.0f), 1.0f);
}

TEST(MergeWeight, lightThatStopsConvergesAnewFromWhatItsRateLeft) {
    // After motion the history stands for 1 / alpha frames, however many it has seen; then noise averages out again.
    ClvMergeSettings settings = settingsOf(0.016f);
    float frames = 5000.0f, weight = clvMergeWeight(settings, 1.0f, frames);
    frames = clvFramesFromWeight(weight) + 1.0f;
    EXPECT_NEAR(frames, 1.0f / clvMergeAlpha(settings, 1.0f) + 1.0f, 1e-4f);
    float history = 0.0f;
    for (int n = 0; n < 1000; ++n) {
        weight = clvMergeWeight(settings, 0.0f, frames);
        history = clvMergeValue(history, 1.0f, weight);
        frames = clvFramesFromWeight(weight) + 1.0f;
    }
    EXPECT_GT(history, 0.99f);
}

TEST(MergeValue, staysBetweenHistoryAndCurrentAndDoesNotDrift) {
    EXPECT_EQ(clvMergeValue(2.0f, 4.0f, 0.25f), 2.5f);
    EXPECT_EQ(clvMergeValue(2.0f, 4.0f, 1.0f), 4.0f);
    for (uint i = 0; i < 10000; ++i) {
        float value = test::randomUnit(2u, i), weight = test::randomUnit(3u, i);
        ASSERT_EQ(clvMergeValue(value, value, weight), value);
        float other = test::randomUnit(4u, i), merged = clvMergeValue(value, other, weight);
        ASSERT_GE(merged, std::min(value, other) * (1.0f - 1e-6f));
        ASSERT_LE(merged, std::max(value, other) * (1.0f + 1e-6f));
    }
}

TEST(MergeValue, aValueThatIsNotFiniteLeavesTheHistoryAlone) {
    for (float bad : {kNan, kInfinity, -kInfinity}) {
        EXPECT_EQ(clvMergeValue(3.0f, bad, 0.5f), 3.0f);
        EXPECT_EQ(clvMergeValue(bad, 3.0f, 0.5f), 3.0f);
        EXPECT_EQ(clvMergeValue(3.0f, 4.0f, bad), 3.0f);
        EXPECT_EQ(clvMergeValue(bad, 4.0f, bad), 4.0f);
    }
}

TEST(MergeDynamicity, theLargestWinsAtOnceAndWearsOff) {
    ClvMergeSettings settings = settingsOf(0.5f);  // one decay time a frame
    EXPECT_EQ(clvMergeDynamicity(settings, 0.2f, 0.9f), 0.9f);
    EXPECT_NEAR(clvMergeDynamicity(settings, 0.8f, 0.0f), 0.8f * std::exp(-1.0f), 1e-6f);
    EXPECT_EQ(clvMergeDynamicity(settings, 0.8f, 0.7f), 0.7f);
    EXPECT_EQ(clvMergeDynamicity(settings, kNan, 0.3f), 0.3f);
    EXPECT_EQ(clvMergeDynamicity(settings, 0.0f, kNan), 0.0f);
}

TEST(LightDynamicity, aLightThatStandsStillHasNone) {
    EXPECT_EQ(clvLightDynamicity(spot(), spot(), kScales), 0.0f);
    ClvLight dark{};
    EXPECT_EQ(clvLightDynamicity(dark, dark, kScales), 0.0f);
}

TEST(LightDynamicity, anIntensityThatIsNotFiniteCountsWhole) {
    for (int channel = 0; channel < 3; ++channel) {
        ClvLight bad = spot();
        bad.intensity[channel] = std::numeric_limits<float>::quiet_NaN();
        EXPECT_EQ(clvLightDynamicity(spot(), bad, kScales), 1.0f);
        EXPECT_EQ(clvLightDynamicity(bad, spot(), kScales), 1.0f);
    }
}

TEST(LightDynamicity, movementCountsInUnitsOfItsScaleUpToOne) {
    ClvLight now = spot();
    now.position = vec3(0.0f, 0.1f, 0.0f);
    EXPECT_NEAR(clvLightDynamicity(spot(), now, kScales), 0.2f, 1e-6f);
    now.position = vec3(9.0f, 0.0f, 0.0f);
    EXPECT_EQ(clvLightDynamicity(spot(), now, kScales), 1.0f);
}

TEST(LightDynamicity, turningCountsByTheAngleHoweverSmall) {
    for (float angle : {1e-4f, 0.01f, 0.1f}) {
        ClvLight now = spot();
        now.direction = turned(angle);
        EXPECT_NEAR(clvLightDynamicity(spot(), now, kScales), angle / 0.2f, 1e-3f * angle / 0.2f);
    }
    ClvLight opposite = spot();
    opposite.direction = -opposite.direction;
    EXPECT_EQ(clvLightDynamicity(spot(), opposite, kScales), 1.0f);
}

TEST(LightDynamicity, conesAndIntensityCountToo) {
    ClvLight wider = spot(), dimmer = spot(), off = spot();
    wider.outerConeAngle += 0.05f;
    EXPECT_NEAR(clvLightDynamicity(spot(), wider, kScales), 0.25f, 1e-5f);
    dimmer.intensity *= 0.9f;
    EXPECT_NEAR(clvLightDynamicity(spot(), dimmer, kScales), 0.1f, 1e-6f);
    off.intensity = vec3(0.0f);
    EXPECT_EQ(clvLightDynamicity(spot(), off, kScales), 1.0f);
    EXPECT_EQ(clvLightDynamicity(off, spot(), kScales), 1.0f);
}

TEST(LightDynamicity, whatALightDoesNotUseDoesNotCount) {
    ClvLight sun = spot(), movedSun = spot();
    sun.type = movedSun.type = kClvLightDirectional;
    movedSun.position = vec3(100.0f);
    movedSun.outerConeAngle = 1.0f;
    EXPECT_EQ(clvLightDynamicity(sun, movedSun, kScales), 0.0f);
    movedSun.direction = turned(0.1f);
    EXPECT_NEAR(clvLightDynamicity(sun, movedSun, kScales), 0.5f, 1e-3f);
    ClvLight bulb = spot(), turnedBulb = spot();
    bulb.type = turnedBulb.type = kClvLightPoint;
    turnedBulb.direction = turned(1.0f);
    EXPECT_EQ(clvLightDynamicity(bulb, turnedBulb, kScales), 0.0f);
}

TEST(LightDynamicity, anotherTypeOrNonFiniteValuesAreFullyDynamic) {
    ClvLight other = spot();
    other.type = kClvLightPoint;
    EXPECT_EQ(clvLightDynamicity(spot(), other, kScales), 1.0f);
    ClvLight broken = spot();
    broken.position.x = kNan;
    EXPECT_EQ(clvLightDynamicity(spot(), broken, kScales), 1.0f);
    broken = spot();
    broken.intensity.y = kInfinity;
    EXPECT_EQ(clvLightDynamicity(spot(), broken, kScales), 1.0f);
}

TEST(MergeStep, aWeightOfOneLeavesNoTraceOfABrightHistory) {
    for (float bright : {1e4f, 1e8f, -1e8f, 1e30f}) {
        EXPECT_EQ(clvMergeStep(bright, 1.0f, 1.0f), 1.0f) << bright;
        EXPECT_EQ(clvMergeStep(vec4(bright), vec4(1.0f, 0.0f, -2.0f, 1e-30f), 1.0f), vec4(1.0f, 0.0f, -2.0f, 1e-30f)) << bright;
    }
}

TEST(MergeDithered, goesOnWhereAPlainMergeStalls) {
    const float weight = 1e-8f;
    const uint merges = 4000000u;
    float plain = 0.75f, dithered = 0.75f;
    for (uint k = 0; k < merges; ++k) {
        plain = clvMergeValue(plain, 1.0f, weight);
        dithered = clvMergeDithered(dithered, 1.0f, weight, clvHash(k));
    }
    const double exact = 1.0 - 0.25 * std::exp(-1e-8 * double(merges));
    EXPECT_EQ(plain, 0.75f);
    EXPECT_NEAR(dithered, exact, 0.01 * (exact - 0.75));
}

TEST(MergeDithered, staysBetweenHistoryAndFrameAndWithinALastPlaceOfTheExactValue) {
    for (uint i = 0; i < 200000; ++i) {
        const float scale = std::ldexp(1.0f, int(test::randomUnit(11u, i) * 200.0f) - 100);
        const float history = scale * (2.0f * test::randomUnit(12u, i) - 1.0f), current = scale * (2.0f * test::randomUnit(13u, i) - 1.0f);
        const float weight = test::randomUnit(14u, i), merged = clvMergeDithered(history, current, weight, clvHash(i));
        ASSERT_GE(merged, std::min(history, current));
        ASSERT_LE(merged, std::max(history, current));
        const double exact = double(history) + double(weight) * (double(current) - double(history));
        ASSERT_NEAR(merged, exact, 4e-7 * double(std::max(std::abs(history), std::abs(current))));
    }
    EXPECT_EQ(clvMergeDithered(3.0f, 3.0f, 0.1f, ~0u), 3.0f);
    EXPECT_EQ(clvMergeDithered(0.0f, 0.0f, 0.1f, ~0u), 0.0f);
    EXPECT_EQ(clvMergeDithered(3.0f, kNan, 0.1f, ~0u), 3.0f);
    EXPECT_EQ(clvMergeDithered(kNan, 3.0f, 0.1f, ~0u), 3.0f);
}

}  // namespace
