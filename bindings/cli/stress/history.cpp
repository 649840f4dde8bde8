// Stiff history: slow and fast light side by side, time steps from 1e-4 s to 1e3 s, ten million merges.
#include <algorithm>
#include <array>
#include <cmath>

#include "bindings/cli/stress/history_formats.h"
#include "bindings/cli/stress/stress_case.h"
#include "clv/cpu/moving_volume.h"
#include "clv/math/hash.h"
#include "clv/stages/merge.h"

namespace clv {
namespace {

float unit(std::uint32_t seed, std::uint64_t index) { return clvUnitFloat(clvHashCombine(clvHashCombine(seed, uint(index >> 32)), uint(index))); }

// One cell, merged with noise of its own size: drift from a run in double precision that sees the same frames.
std::vector<StressFigure> manyMerges(float alpha, double mostDrift, const StressSettings& settings) {
    constexpr std::uint64_t kMerges = 10'000'000;
    float history = 0.0f, frames = 0.0f;
    double shadow = 0.0, worst = 0.0;
    for (std::uint64_t k = 0; k < kMerges; ++k) {
        const float current = 2.0f * unit(settings.seed, k);
        const float weight = std::max(alpha, 1.0f / (frames + 1.0f));
        history = clvMergeStep(history, current, weight);
        frames = clvFramesFromWeight(weight);
        shadow += (double(current) - shadow) * double(weight);
        worst = largerOf(worst, std::abs(history / shadow - 1.0));
    }
    const double noise = std::sqrt(1.0 / 3.0 * std::max(double(alpha) / 2.0, 1.0 / double(kMerges)));
    return {{"largest drift", worst, mostDrift}, {"drift at the end", std::abs(history / shadow - 1.0), mostDrift}, {"noise that is left", noise}};
}

// Eight cells whose sides are lit with dynamicities of 1e-4 to 1, in the library's own volume: a cell is merged as a whole, by the largest of
// its sides.
class SideBySide {
public:
    static constexpr int kCells = 8;
    static constexpr ClvMergeSettings kTimes{0.0f, 10.0f, 0.1f, 1.0f};

    SideBySide() : volume_({.level = {.resolution = ivec3(2), .storage = kClvStorageCube, .linesPerCell = 1}, .layout = {kClvStorageCube, 1}, .movingLights = true}) {
        SceneProbe open;
        open.lineHits = [](const vec3&, const vec3&, float, std::vector<LineHit>& hits) { hits.clear(); };
        open.occluded = [](const vec3&, const vec3&) { return false; };
        volume_.moveTo({.resolution = ivec3(2), .cellSize = 1.0}, nullptr, open, serialFor());
        if (volume_.level().slots.size() != kCells) throw std::runtime_error("an open cell without a slot");
    }

    // Of a side of a cell: each cell has sides of up to four orders of magnitude, and its largest at another one.
    static float dynamicity(int cell, int side) { return std::pow(10.0f, -0.5f * float(cell) - 0.7f * float((side + cell) % int(kSides))); }
    static float largest(int cell) { return std::pow(10.0f, -0.5f * float(cell)); }
    static double rate(int cell) {
        const double still = 1.0 / double(kTimes.stillTime), moving = 1.0 / double(kTimes.movingTime);
        return still + (moving - still) * double(largest(cell));
    }

    // Light of `current` on all sides of the cells from `first` on, for `timestep` seconds.
    void frame(float current, float timestep, int first = 0) {
        const DepositTarget target = volume_.partial(0);
        for (int cell = first; cell < kCells; ++cell) {
            for (int side = 0; side < int(kSides); ++side) {
                target.deposits[index(cell, side)] = current;
                target.dynamicity[std::size_t(cell) * kSides + std::size_t(side)] = dynamicity(cell, side);
            }
        }
        ClvMergeSettings merge = kTimes;
        merge.timestep = timestep;
        volume_.merge(1.0f, merge, serialFor());
    }
    float operator()(int cell, int side = 0) const { return volume_.history()[index(cell, side)]; }

private:
    static std::size_t index(int cell, int side) { return std::size_t(cell) * std::size_t(DepositLayout{kClvStorageCube, 1}.stride()) + std::size_t(side); }
    MovingVolume volume_;
};

// After a step of the light from 0 to 1 every cell follows 1 - exp(-rate t) as long as steps do not get shorter, whatever they are. After a long
// step it is the mean of few frames, and goes on as their plain mean does: faster than that.
std::vector<StressFigure> sideBySide(const StressSettings& settings) {
    constexpr int kDark = 100'001, kFrames = 4000;
    SideBySide cells, lonely;  // in `lonely` the first cell, whose light is the fastest, is dark
    // Long enough that the plain mean is slower than the slowest rate at the shortest step.
    for (int frame = 0; frame < kDark; ++frame) cells.frame(0.0f, 1e-4f), lonely.frame(0.0f, 1e-4f, 1);
    std::array<double, SideBySide::kCells> shadow{}, frames{}, exact{};
    for (int cell = 0; cell < SideBySide::kCells; ++cell) frames[std::size_t(cell)] = std::min(double(kDark), 1.0 / -std::expm1(-SideBySide::rate(cell) * double(1e-4f)));
    double time = 0.0, overshoot = 0.0, fall = 0.0, exponential = 0.0, law = 0.0, slower = 0.0, apart = 0.0, neighbours = 0.0;
    for (int frame = 0; frame < kFrames; ++frame) {
        const bool mixed = frame >= kFrames / 2;
        // Ever longer ones, most of them short, so that all rates are seen at work; then any.
        const float exponent = mixed ? -4.0f + 7.0f * unit(settings.seed, std::uint64_t(frame)) : -4.0f + 7.0f * std::pow(2.0f * float(frame) / float(kFrames), 8.0f);
        const float timestep = std::pow(10.0f, exponent), current = mixed && frame / 50 % 2 == 0 ? 0.0f : 1.0f;
        time += double(timestep);
        for (int cell = 0; cell < SideBySide::kCells; ++cell) exact[std::size_t(cell)] = double(cells(cell));
        cells.frame(current, timestep), lonely.frame(current, timestep, 1);
        for (int cell = 0; cell < SideBySide::kCells; ++cell) {
            const double rate = SideBySide::rate(cell), decay = -std::expm1(-rate * double(timestep)), before = exact[std::size_t(cell)], now = double(cells(cell));
            double &mean = shadow[std::size_t(cell)], &count = frames[std::size_t(cell)];
            const double weight = std::max(decay, 1.0 / (count + 1.0));
            count = 1.0 / weight;
            mean += (double(current) - mean) * weight;
            law = largerOf(law, std::abs(now - mean));
            overshoot = largerOf(overshoot, largerOf(now - 1.0, -now));
            fall = largerOf(fall, std::abs(now - double(current)) - std::abs(before - double(current)));
            slower = largerOf(slower, std::abs(now - double(current)) - (1.0 - decay) * std::abs(before - double(current)));
            if (!mixed) exponential = largerOf(exponential, std::abs(now - -std::expm1(-rate * time)));
            for (int side = 1; side < int(kSides); ++side) apart += cells(cell, side) != cells(cell, 0);
            if (cell > 0) neighbours += cells(cell) != lonely(cell);
        }
    }
    return {{"overshoot", overshoot, 0.0},
            {"steps away from the light", fall, 0.0},
            {"off the exponential of a cell's largest side, steps that grow", exponential, 2e-6},
            {"off the same law in double precision, steps mixed", law, 2e-6},
            {"behind what a cell's largest side asks in a step", slower, 2e-7},
            {"sides that do not follow their cell", apart, 0.0},
            {"cells that a neighbour of other dynamicity changes", neighbours, 0.0}};
}

// Any two values of any sign, any step of time from the smallest float to the largest, any rates: the merge lies between the two, and a longer step goes no less far.
std::vector<StressFigure> anyStep(const StressSettings& settings) {
    const auto anyPower = [&](std::uint64_t index, float least, float most) { return std::pow(10.0f, least + (most - least) * unit(settings.seed, index)); };
    double outside = 0.0, back = 0.0, weights = 0.0;
    const std::uint64_t count = settings.exhaustive ? 100'000'000 : 1'000'000;
    for (std::uint64_t k = 0; k < count; ++k) {
        const uint signs = clvHashCombine(settings.seed, uint(k) + 0x51e5u);
        const float history = anyPower(6 * k, -30.0f, 30.0f) * (signs & 1u ? -1.0f : 1.0f), current = anyPower(6 * k + 1, -30.0f, 30.0f) * (signs & 2u ? -1.0f : 1.0f);
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
    for (float bright : {1e4f, 1e8f, 1e30f}) left = largerOf(left, std::abs(double(clvMergeStep(bright, 1.0f, 1.0f)) - 1.0));
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
    cases.push_back({"history", "ten million merges, plain mean", "float32 follows double precision more closely than the noise that is left", [](const StressSettings& s) { return manyMerges(0.0f, 1.8e-4, s); }});
    cases.push_back({"history", "ten million merges at a weight of 0.001", "float32 follows double precision more closely than the noise that is left", [](const StressSettings& s) { return manyMerges(1e-3f, 1e-5, s); }});
    cases.push_back({"history", "dynamicities of 1e-4 to 1, steps of 1e-4 s to 1e3 s", "a cell follows the exponential of its largest side, never overshoots, and heeds no neighbour", sideBySide});
    cases.push_back({"history", "any two values of any sign, any step of time", "the merge lies between the two, and a longer step goes no less far", anyStep});
    cases.push_back({"history", "light of 1e4 to 1e30 goes out, and light of 1 stays", "a weight of 1 leaves no trace", afterBrightness});
    cases.push_back({"history", "a step of 1e-4 s against a time of 1000 s", "the rate is right, and a dithered history does not stall", slowest});
    return cases;
}

}  // namespace clv
