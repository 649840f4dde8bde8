// What each format that a history may be kept in stalls at, drifts by and is biased by.
#include "bindings/cli/stress/history_formats.h"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "clv/math/hash.h"
#include "clv/math/pack.h"
#include "clv/stages/merge.h"

namespace clv {
namespace {

// A way to keep a value from frame to frame.
struct Format {
    std::string name;
    float (*merged)(float history, float current, float weight, uint random);
    bool isPrecise;  // float32 and what stands in for it: bounds hold for these
};

// Share of a fixed-point history's range that the input fills: room for an input twice as bright.
constexpr float kFixedScale = 1073741824.0f;

// In a shared exponent a channel has as many digits fewer as another one is brighter: beside one ten times as bright.
float besideBrighter(float x) { return clvFloatFromRgb9e5(clvRgb9e5FromFloat(vec3(x, 10.0f * x, x))).x; }

const std::array<Format, 9> kFormats = {{
    {"float32 (the default)", [](float h, float c, float w, uint) { return clvMergeStep(h, c, w); }, true},
    {"float32 dithered", [](float h, float c, float w, uint r) { return clvMergeDithered(h, c, w, r); }, true},
    {"half, to the nearest", [](float h, float c, float w, uint) { return clvFloatFromHalf(clvHalfFromFloat(clvMergeStep(h, c, w))); }, false},
    {"half dithered", [](float h, float c, float w, uint r) { return clvFloatFromHalf(clvHalfDithered(clvMergeStep(h, c, w), r)); }, false},
    {"RGB9E5", [](float h, float c, float w, uint) { return clvFloatFromRgb9e5(clvRgb9e5FromFloat(vec3(clvMergeStep(h, c, w)))).x; }, false},
    {"RGB9E5 beside a channel ten times brighter", [](float h, float c, float w, uint) { return besideBrighter(clvMergeStep(h, c, w)); }, false},
    {"R11G11B10", [](float h, float c, float w, uint) { return clvFloatFromR11g11b10(clvR11g11b10FromFloat(vec3(clvMergeStep(h, c, w)))).x; }, false},
    {"R11G11B10, blue", [](float h, float c, float w, uint) { return clvFloatFromR11g11b10(clvR11g11b10FromFloat(vec3(clvMergeStep(h, c, w)))).z; }, false},
    {"fixed point, 32 bits", [](float h, float c, float w, uint) { return float(int(std::floor(clvMergeStep(h, c, w) * kFixedScale + 0.5f))) / kFixedScale; }, true},
}};

double boundOf(const Format& format, double bound) { return format.isPrecise ? bound : StressFigure::kStated; }

constexpr float kLight = 0.7361f;
// A format's last place is a larger share of a small number than of a large one with the same exponent: lights all over one.
constexpr int kLights = 16;
float lightOf(int k) { return 0.5f + 0.5f * (float(k) + 0.37f) / float(kLights); }

// Light that is switched on and then stands still: how far the history stays below it, for the worst light. Each merge sees the same
// noiseless value.
std::vector<StressFigure> stall(float alpha, const StressSettings& settings) {
    const std::uint64_t merges = std::uint64_t(20.0f / alpha), mean = merges / 2;
    std::vector<StressFigure> figures;
    for (const Format& format : kFormats) {
        double worst = 0.0;
        for (int k = 0; k < kLights; ++k) {
            float history = 0.0f;
            double sum = 0.0;  // of the second half, in which only rounding is left
            for (std::uint64_t merge = 0; merge < merges; ++merge) {
                history = format.merged(history, lightOf(k), alpha, clvHashCombine(settings.seed + uint(k), uint(merge)));
                if (merge >= mean) sum += history;
            }
            worst = largerOf(worst, std::abs(1.0 - sum / double(merges - mean) / double(lightOf(k))));
        }
        figures.push_back({format.name + ", % short", 100.0 * worst, boundOf(format, 0.005)});
    }
    return figures;
}

// The same light on its way up: it follows 1 - (1 - alpha)^n, which has no noise of its own, rises only, and stays below.
std::vector<StressFigure> relaxation(float alpha, const StressSettings& settings) {
    const std::uint64_t merges = std::uint64_t(5.0f / alpha);
    std::vector<StressFigure> figures;
    for (const Format& format : kFormats) {
        double off = 0.0, falls = 0.0;
        for (int k = 0; k < kLights; ++k) {
            float history = 0.0f;
            const float light = lightOf(k);
            for (std::uint64_t merge = 0; merge < merges; ++merge) {
                const float before = history;
                history = format.merged(history, light, alpha, clvHashCombine(settings.seed + uint(k), uint(merge)));
                off = largerOf(off, std::abs(double(history) / double(light) + std::expm1(double(merge + 1) * std::log1p(-double(alpha)))));
                // Dithering to the place below is allowed to fall by it.
                falls += history < before || history > light;
            }
        }
        figures.push_back({format.name + ", % off at most", 100.0 * off, boundOf(format, 0.0005)});
        if (&format == &kFormats[0]) figures.push_back({format.name + ", frames in which it fell or overshot", falls, 0.0});
    }
    return figures;
}

// Frames with noise of the light's own size: what a format keeps of their mean, beside a run in double precision that sees the same frames.
std::vector<StressFigure> noisy(const StressSettings& settings) {
    constexpr float kAlpha = 0.01f;
    const std::uint64_t merges = settings.exhaustive ? 10'000'000 : 1'000'000;
    std::vector<StressFigure> figures;
    for (const Format& format : kFormats) {
        float history = 0.0f;
        double shadow = 0.0, drift = 0.0, bias = 0.0;
        for (std::uint64_t k = 0; k < merges; ++k) {
            const float current = 2.0f * kLight * clvUnitFloat(clvHashCombine(settings.seed, uint(k)));
            history = format.merged(history, current, kAlpha, clvHashCombine(settings.seed + 1u, uint(k)));
            shadow += (double(current) - shadow) * double(kAlpha);
            drift = largerOf(drift, std::abs(double(history) - shadow) / double(kLight));
            bias += (double(history) - shadow) / double(kLight) / double(merges);
        }
        figures.push_back({format.name + ", largest drift, %", 100.0 * drift, boundOf(format, 0.0005)});
        figures.push_back({format.name + ", bias, %", 100.0 * std::abs(bias), boundOf(format, 1e-5)});
    }
    return figures;
}

}  // namespace

std::vector<StressCase> historyFormatCases() {
    std::vector<StressCase> cases;
    for (float alpha : {0.05f, 0.01f, 0.005f}) {
        const std::string name = fmt::format("at a weight of {:g}", alpha);
        cases.push_back({"history", "stall " + name, "the default format ends within 0.005 % of any light", [alpha](const StressSettings& s) { return stall(alpha, s); }});
        cases.push_back({"history", "relaxation " + name, "the default format follows 1 - (1 - a)^n within 0.0005 %, rises only and never overshoots", [alpha](const StressSettings& s) { return relaxation(alpha, s); }});
    }
    cases.push_back({"history", "noisy frames in every format", "the default format follows double precision within 0.0005 %, without a bias", noisy});
    return cases;
}

}  // namespace clv
