// What measurements say together, on made-up ones.
#include "benchmarks/report/curves.h"

#include <cmath>

#include <gtest/gtest.h>

namespace {

using namespace clv;

Measurement made(const std::string& method, double milliseconds, double error, std::uint64_t rays = 1) {
    Measurement m;
    m.scene = std::string(1, 's'), m.method = method, m.rays = m.raysTraced = rays;
    m.frameSeconds = 1e-3 * milliseconds, m.errors.relativeRmse = error;
    m.receivers = 100;
    return m;
}

const std::vector<Measurement> kMade = {made("a", 1, 0.4, 1), made("a", 4, 0.2, 4), made("a", 16, 0.1, 16), made("b", 2, 0.5, 1), made("b", 3, 0.1, 9)};

TEST(Curves, aSceneHasOneForEachMethodByRisingWork) {
    std::vector<Measurement> mixed = kMade;
    std::swap(mixed[0], mixed[2]);
    mixed.push_back(made("a", 1, 1.0));
    mixed.back().scene.push_back('2');
    const auto curves = curvesOf(mixed, "s");
    ASSERT_EQ(curves.size(), 2u);
    EXPECT_EQ(curves[0].name, "a");
    ASSERT_EQ(curves[0].points.size(), 3u);
    EXPECT_EQ(curves[0].points[0]->rays, 1u);
    EXPECT_EQ(curves[0].points[2]->rays, 16u);
    EXPECT_EQ(scenesOf(mixed), (std::vector<std::string>{"s", "s2"}));
}

TEST(Curves, theFrontHoldsWhatNothingBeatsInTimeAndError) {
    const auto curves = curvesOf(kMade, "s");
    const Points front = paretoFront(pointsOf(curves), 0);
    ASSERT_EQ(front.size(), 2u);
    EXPECT_EQ(front[0], &kMade[0]);
    EXPECT_EQ(front[1], &kMade[4]);
}

TEST(Curves, theBestWithinABudgetIsTheOneThatErrsLeast) {
    const Points points = pointsOf(curvesOf(kMade, "s"));
    EXPECT_EQ(bestWithin(points, 0.5e-3, 0), nullptr);
    EXPECT_EQ(bestWithin(points, 2.5e-3, 0), &kMade[0]);
    EXPECT_EQ(bestWithin(points, 1.0, 0), &kMade[4]);
}

TEST(Curves, timeToAnErrorLiesOnAStraightLineInLogarithms) {
    const Points a = curvesOf(kMade, "s")[0].points;
    EXPECT_NEAR(*secondsToReach(a, 0.2, 0), 4e-3, 1e-12);
    EXPECT_NEAR(*secondsToReach(a, std::sqrt(0.4 * 0.2), 0), 2e-3, 1e-12);
    EXPECT_NEAR(*secondsToReach(a, 0.9, 0), 1e-3, 1e-12);
    EXPECT_FALSE(secondsToReach(a, 0.05, 0));
}

TEST(Curves, readersPayForLookupsOrForRaysOfTheirOwn) {
    Measurement shared = made("a", 10, 0.1), own = made("b", 10, 0.1);
    shared.lookupSeconds = own.lookupSeconds = 1e-3;
    own.sharesRays = false;
    EXPECT_NEAR(shared.seconds(100), 11e-3, 1e-12);
    EXPECT_NEAR(shared.seconds(1000), 20e-3, 1e-12);
    EXPECT_NEAR(own.seconds(100), 11e-3, 1e-12);
    EXPECT_NEAR(own.seconds(1000), 110e-3, 1e-12);
}

TEST(Curves, whatReadsWholePicturesServesNoFewPoints) {
    std::vector<Measurement> all = {made("a", 4, 0.2), made("a", 1, 0.1)};
    all[1].wholePicture = true, all[1].receivers = 1000, all[1].lookupSeconds = 2e-3;
    EXPECT_TRUE(std::isinf(all[1].seconds(999)));
    EXPECT_NEAR(all[1].seconds(1000), 3e-3, 1e-12);
    EXPECT_NEAR(all[1].seconds(2000), 5e-3, 1e-12);
    const Points points = pointsOf(curvesOf(all, "s"));
    EXPECT_EQ(paretoFront(points, 100), Points{&all[0]});
    EXPECT_EQ(bestWithin(points, 1.0, 100), &all[0]);
    EXPECT_FALSE(secondsToReach(points, 0.15, 100));
    EXPECT_EQ(paretoFront(points, 1000), Points{&all[1]});
    EXPECT_TRUE(measurementFrom(toJson(all[1])).wholePicture);
}

TEST(Curves, aKindHoldsAllSettingsButTellsTheChosenResolutionAndLightAnywhere) {
    std::vector<Measurement> all = {made("a", 1, 1), made("a", 1, 1), made("a", 1, 1), made("a", 1, 1), made("b", 1, 1)};
    all[0].settings = {{"resolution", "16"}, {"readers", "surfaces"}};
    all[1].settings = {{"resolution", "32"}, {"readers", "surfaces"}};
    all[2].settings = {{"resolution", "chosen"}, {"readers", "surfaces"}};
    all[3].settings = {{"resolution", "16"}, {"readers", "anywhere"}};
    const auto kinds = kindsOf(all, "s");
    ASSERT_EQ(kinds.size(), 4u);
    EXPECT_EQ(kinds[0].name, "a");
    EXPECT_EQ(kinds[0].points, (Points{&all[0], &all[1]}));
    EXPECT_EQ(kinds[1].name, "a, resolution chosen");
    EXPECT_EQ(kinds[2].name, "a, light anywhere");
    EXPECT_EQ(kinds[3].name, "b");
}

TEST(Curves, aFallWithAFloorIsFound) {
    std::vector<double> work, errors;
    for (double n = 1e3; n < 1e7; n *= 4.0) work.push_back(n), errors.push_back(std::hypot(0.03, 20.0 * std::pow(n, -0.55)));
    const auto fall = fitErrorFall(work, errors);
    ASSERT_TRUE(fall);
    EXPECT_NEAR(fall->slope, -0.55, 0.01);
    EXPECT_NEAR(fall->floor, 0.03, 0.001);
    EXPECT_NEAR(fall->at(5e4), std::hypot(0.03, 20.0 * std::pow(5e4, -0.55)), 1e-3);
    EXPECT_FALSE(fitErrorFall(std::span(work).first(2), std::span(errors).first(2)));
    work[0] = 0.0;
    EXPECT_FALSE(fitErrorFall(work, errors)) << "no rays";
}

TEST(Curves, labelsHoldTheSettingsThatTellAMethodsCurvesApart) {
    std::vector<Measurement> all = {made("a", 1, 1, 65536), made("a", 1, 1, 1 << 20), made("b", 1, 1)};
    all[0].settings = {{"resolution", "16"}, {"storage", "cube9"}};
    all[1].settings = {{"resolution", "32"}, {"storage", "cube9"}};
    all[1].frames = 16;
    const CurveLabels labels(all);
    EXPECT_EQ(labels.setting(all[0]), "a (resolution 16), 64k rays");
    EXPECT_EQ(labels.setting(all[1]), "a (resolution 32), 16 frames of 1M rays");
    EXPECT_EQ(labels.curve(all[2]), "b");
    all[1].settings = all[0].settings, all[1].settings.emplace_back("pixels", "1 in 16");
    EXPECT_EQ(CurveLabels(all).curve(all[0]), "a") << "what another curve alone has";
    EXPECT_EQ(CurveLabels(all).curve(all[1]), "a (pixels 1 in 16)");
    all[2].raysTraced = 0, all[2].frames = 4;
    EXPECT_EQ(labels.setting(all[2]), "b, 4 frames");
}

}  // namespace
