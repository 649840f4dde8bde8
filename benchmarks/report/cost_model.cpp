#include "benchmarks/report/cost_model.h"

#include <algorithm>
#include <cmath>

#include "benchmarks/report/statistics.h"

namespace clv {
namespace {

// Of a frame, as far as forecasts go.
constexpr double kLeastRays = 256, kMostRays = 64.0 * (1 << 20);
constexpr double kRayStep = 1.02;
// Falls of noise that are tried: between that of a slow sequence and that of a very good one.
constexpr double kSlowestFall = -0.3, kFastestFall = -0.8, kFallStep = 0.005;

double lineSeconds(const Trial& trial, double rays) {
    const double slope = std::max(0.0, (trial.seconds - trial.fewSeconds) / (trial.rays - trial.fewRays));
    const double offset = rays < trial.fewRays ? trial.leastSeconds - slope * trial.leastRays : trial.fewSeconds - slope * trial.fewRays;
    return std::max(0.0, offset) + slope * rays;
}

double seconds(const Trial& trial, double rays, double growth) {
    return lineSeconds(trial, rays) * std::pow(std::max(1.0, rays / trial.rays), growth);
}

double noise(const Trial& trial, double rays, double fall) {
    const auto between = [&](double lo, double loNoise, double hi, double hiNoise) { return loNoise * std::pow(hiNoise / loNoise, std::log(rays / lo) / std::log(hi / lo)); };
    if (rays >= trial.rays) return trial.noise * std::pow(rays / trial.rays, fall);
    if (rays <= trial.leastRays) return trial.leastNoise * std::pow(rays / trial.leastRays, fall);
    if (rays <= trial.fewRays) return between(trial.leastRays, trial.leastNoise, trial.fewRays, trial.fewNoise);
    return between(trial.fewRays, trial.fewNoise, trial.rays, trial.noise);
}

double error(const Trial& trial, double rays, double fall) { return std::hypot(trial.floor, noise(trial, rays, fall)); }

// Sum over all outcomes of the squared logarithm of true value over forecast.
template <class Misfit>
double sumOfSquares(std::span<const TrialOutcomes> all, Misfit&& misfit) {
    double sum = 0.0;
    for (const TrialOutcomes& one : all) {
        for (const Outcome& outcome : one.outcomes) sum += std::pow(misfit(one.trial, outcome), 2.0);
    }
    return sum;
}

double factorOf(double squares, int count) {
    const int degrees = std::max(1, count - 1);
    return std::exp(studentQuantile(kConfidence, degrees) * std::sqrt(squares / degrees));
}

template <class Better>
std::optional<Forecast> best(const CostModel& model, std::span<const Trial> trials, Better&& better) {
    std::optional<Forecast> found;
    for (const Trial& trial : trials) {
        for (double rays = kLeastRays; rays <= kMostRays; rays *= kRayStep) {
            const Forecast next = model.forecast(trial, std::floor(rays));
            if (better(next, found)) found = next;
        }
    }
    return found;
}

}  // namespace

CostModel CostModel::fit(std::span<const TrialOutcomes> all) {
    CostModel model;
    double xy = 0.0, xx = 0.0;
    int count = 0;
    for (const TrialOutcomes& one : all) {
        for (const Outcome& outcome : one.outcomes) {
            const double x = std::log(std::max(1.0, outcome.rays / one.trial.rays));
            xy += x * std::log(outcome.seconds / lineSeconds(one.trial, outcome.rays)), xx += x * x;
            ++count;
        }
    }
    model.timeGrowth_ = xx > 0.0 ? xy / xx : 0.0;
    double least = 1e300;
    for (double fall = kSlowestFall; fall >= kFastestFall; fall -= kFallStep) {
        const double misfit = sumOfSquares(all, [&](const Trial& trial, const Outcome& o) { return std::log(o.error / error(trial, o.rays, fall)); });
        if (misfit < least) least = misfit, model.noiseFall_ = fall;
    }
    model.errorFactor_ = factorOf(least, count);
    model.secondsFactor_ = factorOf(sumOfSquares(all, [&](const Trial& trial, const Outcome& o) { return std::log(o.seconds / seconds(trial, o.rays, model.timeGrowth_)); }), count);
    return model;
}

Forecast CostModel::forecast(const Trial& trial, double rays) const {
    return {trial.resolution, rays, seconds(trial, rays, timeGrowth_), error(trial, rays, noiseFall_), secondsFactor_, errorFactor_};
}

std::optional<Forecast> CostModel::within(double budget, std::span<const Trial> trials) const {
    return best(*this, trials, [&](const Forecast& next, const std::optional<Forecast>& found) {
        return next.seconds <= budget && (!found || next.error < found->error);
    });
}

std::optional<Forecast> CostModel::reaching(double target, std::span<const Trial> trials) const {
    return best(*this, trials, [&](const Forecast& next, const std::optional<Forecast>& found) {
        return next.error <= target && (!found || next.seconds < found->seconds);
    });
}

nlohmann::json CostModel::toJson() const {
    return {{"time_growth", timeGrowth_}, {"noise_fall", noiseFall_}, {"seconds_factor", secondsFactor_}, {"error_factor", errorFactor_}};
}

CostModel CostModel::fromJson(const nlohmann::json& json) {
    CostModel model;
    model.timeGrowth_ = json.at("time_growth"), model.noiseFall_ = json.at("noise_fall");
    model.secondsFactor_ = json.at("seconds_factor"), model.errorFactor_ = json.at("error_factor");
    return model;
}

}  // namespace clv
