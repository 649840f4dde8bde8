// Forecasts of cost and error, against made-up machines and scenes.
#include "benchmarks/report/cost_model.h"

#include <cmath>

#include <gtest/gtest.h>

namespace {

using namespace clv;

constexpr double kLeast = 2048, kFew = 8192, kRays = 65536;  // of the trials' frames

// A machine: 0.5 ms, another 0.5 ms for pilots, and so many nanoseconds a ray, more the more rays; noise falls with a power of them.
struct Machine {
    double nanoseconds = 150, growth = 0.1, fall = -0.55;

    double seconds(double rays) const {
        return ((rays < kFew ? 0.5e-3 : 1e-3) + 1e-9 * nanoseconds * rays) * std::pow(std::max(1.0, rays / kRays), growth);
    }
};
struct World {
    double floor = 0.05, noise = 0.3;  // at the trial's rays
};

Trial trialIn(const Machine& machine, const World& world, int resolution = 32) {
    return {resolution, kLeast, kFew, kRays, machine.seconds(kLeast), machine.seconds(kFew), machine.seconds(kRays),
            world.noise * std::pow(kLeast / kRays, machine.fall), world.noise * std::pow(kFew / kRays, machine.fall), world.noise, world.floor};
}
double errorIn(const Machine& machine, const World& world, double rays) {
    return std::hypot(world.floor, world.noise * std::pow(rays / kRays, machine.fall));
}

// `jitter`: outcomes lie off by this factor, up and down in turns.
CostModel fitted(const Machine& machine, double jitter = 1.0) {
    std::vector<TrialOutcomes> all;
    bool up = false;
    for (const World& world : {World{0.02, 0.1}, World{0.1, 0.4}, World{0.2, 0.2}}) {
        TrialOutcomes one{trialIn(machine, world), {}};
        for (const double rays : {16384.0, 262144.0, 1048576.0}) {
            const double factor = (up = !up) ? jitter : 1.0 / jitter;
            one.outcomes.push_back({rays, factor * machine.seconds(rays), factor * errorIn(machine, world, rays)});
        }
        all.push_back(one);
    }
    return CostModel::fit(all);
}

TEST(CostModel, findsTheLawOfTheMachineAndForetellsAnotherScene) {
    const Machine machine;
    const CostModel model = fitted(machine);
    const World other{0.07, 0.5};
    for (const double rays : {300.0, 3e3, 8e3, 1e4, 1e5, 4e6}) {
        const Forecast forecast = model.forecast(trialIn(machine, other), rays);
        EXPECT_NEAR(forecast.seconds / machine.seconds(rays), 1.0, 0.02) << rays;
        EXPECT_NEAR(forecast.error / errorIn(machine, other, rays), 1.0, 0.02) << rays;
        EXPECT_LT(forecast.secondsFactor, 1.05);
        EXPECT_LT(forecast.errorFactor, 1.05);
    }
}

TEST(CostModel, noiseIsWhatTheTrialsFramesShowed) {
    Trial trial = trialIn(Machine(), {0.0, 0.1});
    trial.leastNoise = 0.9, trial.fewNoise = 0.4;
    const CostModel model = fitted(Machine());
    EXPECT_NEAR(model.forecast(trial, kLeast).error, 0.9, 1e-6);
    EXPECT_NEAR(model.forecast(trial, kFew).error, 0.4, 1e-6);
    EXPECT_NEAR(model.forecast(trial, std::sqrt(kFew * kRays)).error, 0.2, 1e-6) << "half-way in logarithms";
    EXPECT_NEAR(model.forecast(trial, kLeast / 4.0).error / 0.9, std::pow(4.0, 0.55), 0.02);
}

TEST(CostModel, isLessSureWhereOutcomesScatter) {
    const CostModel model = fitted(Machine(), 1.15);
    const Forecast forecast = model.forecast(trialIn(Machine(), World()), 1e6);
    EXPECT_GT(forecast.secondsFactor, 1.15);
    EXPECT_LT(forecast.secondsFactor, 1.6);
    EXPECT_GT(forecast.errorFactor, 1.15);
    EXPECT_LT(forecast.errorFactor, 1.6);
}

TEST(CostModel, aBudgetBuysTheSettingThatErrsLeast) {
    const Machine coarse{.nanoseconds = 100}, fine{.nanoseconds = 300};
    const std::vector<Trial> trials = {trialIn(coarse, {0.1, 0.1}, 16), trialIn(fine, {0.02, 0.4}, 64)};
    const CostModel model = fitted(coarse);
    const auto little = model.within(5e-3, trials), much = model.within(2.0, trials);
    ASSERT_TRUE(little && much);
    EXPECT_EQ(little->resolution, 16) << "noise decides";
    EXPECT_EQ(much->resolution, 64) << "the floor decides";
    EXPECT_LE(little->seconds, 5e-3);
    EXPECT_GT(little->seconds, 0.9 * 5e-3);
    EXPECT_FALSE(model.within(0.4e-3, trials)) << "what no ray costs is more";
}

TEST(CostModel, anErrorIsReachedInTheLeastTime) {
    const Machine coarse{.nanoseconds = 100}, fine{.nanoseconds = 300};
    const std::vector<Trial> trials = {trialIn(coarse, {0.1, 0.1}, 16), trialIn(fine, {0.02, 0.4}, 64)};
    const CostModel model = fitted(coarse);
    const auto rough = model.reaching(0.15, trials), exact = model.reaching(0.05, trials);
    ASSERT_TRUE(rough && exact);
    EXPECT_EQ(rough->resolution, 16);
    EXPECT_EQ(exact->resolution, 64);
    EXPECT_LE(exact->error, 0.05);
    EXPECT_GT(exact->error, 0.9 * 0.05);
    EXPECT_FALSE(model.reaching(0.01, trials)) << "below all floors";
}

TEST(CostModel, isTheSameAfterItWasKept) {
    const CostModel model = fitted(Machine(), 1.1), kept = CostModel::fromJson(model.toJson());
    const Trial trial = trialIn(Machine(), World());
    EXPECT_EQ(kept.forecast(trial, 1e6).seconds, model.forecast(trial, 1e6).seconds);
    EXPECT_EQ(kept.forecast(trial, 1e6).errorFactor, model.forecast(trial, 1e6).errorFactor);
    EXPECT_THROW(CostModel::fromJson({{"time_growth", 1}}), nlohmann::json::exception);
}

}  // namespace
