// Stiff history: slow and fast light side by side, time steps from 1e-4 s to 1e3 s, ten million merges.
#include <algorithm>
#include <array>
#include <cmath>

#include "bindings/cli/stress/history_formats.h"
#include "bindings/cli/stress/stress_case.h"
#include "clv/math/hash.h"
#include "clv/stages/merge.h"

namespace clv {
namespace {

float unit(std::uint32_t seed, std::uint64_t index) { return clvUnitFloat(clvHashCombine(clvHashCombine(seed, uint(index >> 32)), uint(index))); }

// One cell, merged with noise of its own size: drift from a run in double precision that sees the same frames.
std::vector<StressFigure> manyMerges(float alpha, const StressSettings& settings) {
    constexpr std::uint64_t kMerges = 10'000'000;
    float history = 0.0f, frames = 0.0f;
    double shadow = 0.0, worst = 0.0;
    for (std::uint64_t k = 0; k < kMerges; ++k) {
        const float current = 2.0f * unit(settings.seed, k);
        const float weight = std::max(alpha, 1.0f / (frames + 1.0f));
        history = clvMergeStep(history, current, weight);
        frames = clvFramesFromWeight(weight);
        shadow += (double(current) - shadow) * double(weight);
        worst = std::max(worst, std::abs(history / shadow - 1.0));
    }
    // Below the noise that is left in the mean.
    const double noise = std::sqrt(1.0 / 3.0 * std::max(double(alpha) / 2.0, 1.0 / double(kMerges)));
    return {{"largest drift", worst, noise}, {"drift at the end", std::abs(history / shadow - 1.0), noise}, {"noise that is left", noise}};
}

// Sides whose dynamicity differs by up to four orders of magnitude, and time steps that differ by seven, mixed: after a step of the
// light from 0 to 1 each side must follow 1 - exp(-rate t) whatever the steps were, rise only, and never overshoot.
std::vector<StressFigure> sideBySide(const StressSettings& settings) {
    constexpr int kSides = 9, kFrames = 4000;
    ClvMergeSettings merge{0.0f, 100.0f, 0.1f, 1.0f};
    std::array<float, kSides> history{};
    double time = 0.0, overshoot = 0.0, fall = 0.0, error = 0.0, late = 0.0;
    for (int frame = 0; frame < kFrames; ++frame) {
        // Small steps first, so that all rates are seen at work; then any.
        const float exponent = frame < kFrames / 2 ? -4.0f + 2.0f * unit(settings.seed, std::uint64_t(frame)) : -4.0f + 7.0f * unit(settings.seed, std::uint64_t(frame));
        merge.timestep = std::pow(10.0f, exponent);
        time += double(merge.timestep);
        for (int side = 0; side < kSides; ++side) {
            const float dynamicity = std::pow(10.0f, -0.5f * float(side));
            const float before = history[side];
            history[side] = clvMergeStep(before, 1.0f, clvMergeAlpha(merge, dynamicity));
            overshoot = std::max(overshoot, double(history[side]) - 1.0);
            fall = std::max(fall, double(before) - double(history[side]));
            const double rate = 1.0 / double(merge.stillTime) + (1.0 / double(merge.movingTime) - 1.0 / double(merge.stillTime)) * double(dynamicity);
            error = std::max(error, std::abs(double(history[side]) - -std::expm1(-rate * time)));
        }
    }
    for (float value : history) late = std::max(late, 1.0 - double(value));
    return {{"overshoot", overshoot, 0.0}, {"fall", fall, 0.0}, {"off the exponential", error, 1e-4}, {"missing in the end", late, 5e-4}};
}

// Any two values, any step of time from the smallest float to the largest, any rates: the merge lies between the two, and a longer step goes no less far.
std::vector<StressFigure> anyStep(const StressSettings& settings) {
    const auto anyPower = [&](std::uint64_t index, float least, float most) { return std::pow(10.0f, least + (most - least) * unit(settings.seed, index)); };
    double outside = 0.0, back = 0.0, weights = 0.0;
    const std::uint64_t count = settings.exhaustive ? 100'000'000 : 1'000'000;
    for (std::uint64_t k = 0; k < count; ++k) {
        const float history = anyPower(6 * k, -30.0f, 30.0f), current = anyPower(6 * k + 1, -30.0f, 30.0f);
        const float stillTime = anyPower(6 * k + 2, -30.0f, 18.0f);
        const ClvMergeSettings merge{anyPower(6 * k + 3, -38.0f, 38.0f), stillTime, stillTime * unit(settings.seed, 6 * k + 4) + 1e-38f, 1.0f};
        ClvMergeSettings longer = merge;
        longer.timestep *= 1.0f + unit(settings.seed, 6 * k + 5);
        const float dynamicity = unit(settings.seed, 6 * k + 5);
        const float weight = clvMergeAlpha(merge, dynamicity), more = clvMergeAlpha(longer, dynamicity);
        const float merged = clvMergeStep(history, current, weight);
        weights += !(weight >= 0.0f && weight <= 1.0f);
        outside += !(merged >= std::min(history, current) && merged <= std::max(history, current));
        // The decay's two branches meet within their last places.
        back += more < weight * (1.0f - 0x1p-20f);
    }
    return {{"weights outside of [0, 1]", weights, 0.0}, {"merges that overshoot, or go the other way", outside, 0.0}, {"longer steps of less weight", back, 0.0}};
}

// A bright light goes out, and a dim one stays: a frame that replaces the history leaves nothing of it.
std::vector<StressFigure> afterBrightness(const StressSettings&) {
    double left = 0.0;
    for (float bright : {1e4f, 1e8f, 1e30f}) left = std::max(left, std::abs(double(clvMergeStep(bright, 1.0f, 1.0f)) - 1.0));
    return {{"off the dim light by", left, 0.0}};
}

// The smallest rate that a setting can ask for: a step of 1e-4 s against a time of 1000 s.
std::vector<StressFigure> slowest(const StressSettings& settings) {
    const ClvMergeSettings merge{1e-4f, 1e3f, 0.1f, 1.0f};
    const float alpha = clvMergeAlpha(merge, 0.0f);
    const std::uint64_t merges = settings.exhaustive ? 100'000'000 : 20'000'000;
    float plain = 0.5f, dithered = 0.5f;
    for (std::uint64_t k = 0; k < merges; ++k) {
        plain = clvMergeStep(plain, 1.0f, alpha);
        dithered = clvMergeDithered(dithered, 1.0f, alpha, clvHashCombine(settings.seed, uint(k)));
    }
    const double exact = 1.0 - 0.5 * std::exp(-1e-7 * double(merges));
    return {{"error of the rate", std::abs(double(alpha) / -std::expm1(-1e-7) - 1.0), 1e-6},
            {"plain float32, % short", 100.0 * (1.0 - double(plain) / exact)},
            {"dithered, % short", 100.0 * std::abs(1.0 - double(dithered) / exact), 0.05}};
}

}  // namespace

std::vector<StressCase> historyCases() {
    std::vector<StressCase> cases = historyFormatCases();
    cases.push_back({"history", "ten million merges, plain mean", "float32 follows double precision more closely than the noise that is left", [](const StressSettings& s) { return manyMerges(0.0f, s); }});
    cases.push_back({"history", "ten million merges at a weight of 0.001", "float32 follows double precision more closely than the noise that is left", [](const StressSettings& s) { return manyMerges(1e-3f, s); }});
    cases.push_back({"history", "dynamicities of 1e-4 to 1, steps of 1e-4 s to 1e3 s", "each side follows its exponential, and never overshoots", sideBySide});
    cases.push_back({"history", "any two values, any step of time", "the merge lies between the two, and a longer step goes no less far", anyStep});
    cases.push_back({"history", "light of 1e4 to 1e30 goes out, and light of 1 stays", "a weight of 1 leaves no trace", afterBrightness});
    cases.push_back({"history", "a step of 1e-4 s against a time of 1000 s", "the rate is right, and a dithered history does not stall", slowest});
    return cases;
}

}  // namespace clv
