// Light that is zero, negative, not finite or as bright as a float can be; dim light beside bright; sums in fixed point.
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "bindings/cli/stress/stress_case.h"
#include "clv/cpu/build_level.h"
#include "clv/cpu/evaluate.h"
#include "clv/cpu/inject.h"
#include "clv/cpu/partial_volume.h"
#include "clv/math/hash.h"
#include "clv/plan/number_check.h"

namespace clv {
namespace {

constexpr int kSide = 8;  // cells

Level openLevel(float cellSize = 0.5f, uint storage = kClvStorageCube9) {
    ClvVolume volume{};
    volume.origin = vec3(-4.0f * cellSize), volume.cellSize = cellSize, volume.resolution = ivec3(kSide), volume.storage = storage;
    return buildLevel(volume, {}, {}, serialFor(), {.linesPerCell = 0, .findRegions = false});
}

ClvRay rayThrough(uint seed, uint index, const vec3& flux) {
    const auto unit = [&](uint k) { return clvUnitFloat(clvHashCombine(clvHashCombine(seed, index), k)); };
    ClvRay ray{};
    ray.origin = 4.0f * vec3(unit(0), unit(1), unit(2)) - 2.0f;
    ray.direction = glm::normalize(vec3(unit(3), unit(4), unit(5)) - 0.5f + 1e-3f);
    ray.maxDistance = 3.0f * unit(6);
    ray.flux = flux;
    return ray;
}

// Deposits of `rays`, in one partial volume.
PartialVolume deposit(const Level& level, const DepositLayout& layout, std::span<const ClvRay> rays) {
    PartialVolume partial;
    partial.resize(level.slots.size(), layout, false);
    inject(level, layout, kClvInjectTrackLength, rays, partial.target());
    return partial;
}

// Bad rays among good ones: what they add, beside what the good ones add alone.
std::vector<StressFigure> badAmongGood(const StressSettings& settings) {
    const float nan = std::nanf(""), inf = HUGE_VALF;
    const Level level = openLevel();
    const DepositLayout layout;
    std::vector<ClvRay> good, all;
    for (uint k = 0; k < 4000; ++k) {
        const ClvRay ray = rayThrough(settings.seed, k, vec3(0.3f, 0.2f, 0.1f));
        good.push_back(ray);
        all.push_back(ray);
        ClvRay bad = ray;
        switch (k % 12) {
            case 0: bad.flux.x = nan; break;
            case 1: bad.flux.y = inf; break;
            case 2: bad.flux.z = -inf; break;
            case 3: bad.direction.x = nan; break;
            case 4: bad.direction = vec3(inf, 0.0f, 0.0f); break;
            case 5: bad.origin.z = nan; break;
            case 6: bad.origin.y = -inf; break;
            case 7: bad.maxDistance = nan; break;
            case 8: bad.maxDistance = -1.0f; break;
            case 9: bad.flux = vec3(0.0f); break;
            case 10: bad.direction = vec3(0.0f); break;
            case 11: bad.maxDistance = 0.0f; break;
        }
        all.push_back(bad);
    }
    PartialVolume with = deposit(level, layout, all), without = deposit(level, layout, good);
    double worst = 0.0, largest = 0.0, notFinite = 0.0;
    for (std::size_t k = 0; k < with.target().deposits.size(); ++k) {
        const double a = with.target().deposits[k], b = without.target().deposits[k];
        notFinite += !isFinite(a);
        worst = largerOf(worst, std::abs(a - b)), largest = largerOf(largest, std::abs(b));
    }
    // The order of the sums differs, by the rays between them.
    return {{"deposits that are not finite", notFinite, 0.0}, {"what bad rays add, of the largest deposit", worst / largest, 1e-6}};
}

// Deposits are linear in the flux, over the range of floats: times a power of two they are the same to the bit.
std::vector<StressFigure> linearity(const StressSettings& settings) {
    const Level level = openLevel();
    const DepositLayout layout;
    double differing = 0.0;
    for (int power : {-90, -30, 30, 90}) {
        std::vector<ClvRay> one, scaled;
        for (uint k = 0; k < 500; ++k) {
            one.push_back(rayThrough(settings.seed, k, vec3(0.3f, 0.2f, 0.1f)));
            scaled.push_back(one.back());
            scaled.back().flux *= std::ldexp(1.0f, power);
        }
        PartialVolume a = deposit(level, layout, one), b = deposit(level, layout, scaled);
        for (std::size_t k = 0; k < a.target().deposits.size(); ++k) {
            const float expected = std::ldexp(a.target().deposits[k], power);
            // What falls below the smallest normal float loses digits.
            differing += std::abs(expected) > 1e-37f && b.target().deposits[k] != expected;
        }
    }
    return {{"deposits that differ", differing, 0.0}};
}

// Rays as bright as floats are, through cells of 1 nm to 100 km: a ray adds at most kClvMostDeposit, and what is read is what a 2^90th of the
// same rays gives, times as much, or the most that is ever read.
std::vector<StressFigure> brightest(const StressSettings& settings) {
    constexpr int kPower = 90;
    double notFinite = 0.0, tooMuch = 0.0, off = 0.0, instead = 0.0, dark = 0.0;
    for (float cellSize : {1e-9f, 0.5f, 1e5f}) {
        for (uint storage : {kClvStorageCube9, kClvStorageCube, kClvStorageSh1, kClvStorageSh2}) {
            const Level level = openLevel(cellSize, storage);
            const DepositLayout layout{storage, 3};
            const float most = clvMostFlux(kClvInjectTrackLength, cellSize);
            std::vector<ClvRay> rays, faint;
            for (uint k = 0; k < 2000; ++k) {
                rays.push_back(rayThrough(settings.seed, k, vec3(k % 2 == 0 ? 3.4e38f : 1e38f)));
                rays.back().origin *= 2.0f * cellSize, rays.back().maxDistance = 1e30f;
                faint.push_back(rays.back());
                faint.back().flux = vec3(std::ldexp(std::min(rays.back().flux.x, most), -kPower));
            }
            const PartialVolume partial = deposit(level, layout, rays), small = deposit(level, layout, faint);
            for (float value : partial.deposits) notFinite += !clvIsFinite(value), tooMuch += std::abs(value) > 2000.0f * kClvMostDeposit;
            SlotWeights weights;
            double mean = 0.0;
            for (uint k = 0; k < 200; ++k) {
                const ClvRay at = rayThrough(settings.seed + 1u, k, vec3(1.0f));
                lookupWeights(level, {at.origin * 2.0f * cellSize, 0.0f, at.direction, 0.0f}, {}, weights);
                const vec3 e = readIrradiance(layout, partial.deposits, weights, layout.read(at.direction)), expected = readIrradiance(layout, small.deposits, weights, layout.read(at.direction));
                for (int c = 0; c < 3; ++c) {
                    const double exact = std::min(std::ldexp(double(expected[c]), kPower), double(kClvMostIrradiance));
                    // In cells of 1 nm the terms of the sum are no floats any more: the most that is read stands for what they give.
                    if (cellSize < 1e-6f && e[c] == kClvMostIrradiance && exact < double(kClvMostIrradiance)) ++instead;
                    else if (exact > 0.0) off = largerOf(off, std::abs(double(e[c]) / exact - 1.0));
                    else off = largerOf(off, double(e[c]) > 0.0 ? 1.0 : 0.0);
                }
                mean += double(e.x);
            }
            dark += !(mean > 0.0);
        }
    }
    return {{"deposits that are not finite", notFinite, 0.0},
            {"deposits beyond the most that so many rays add", tooMuch, 0.0},
            {"irradiance off by", off, 1e-6},
            {"of 2400 in cells of 1 nm, those of 1e38 in place of less", instead}, {"grids that are dark", dark, 0.0}};
}

// A ray of negative flux takes away what it would add.
std::vector<StressFigure> negative(const StressSettings& settings) {
    const Level level = openLevel();
    const DepositLayout layout;
    std::vector<ClvRay> rays;
    for (uint k = 0; k < 2000; ++k) rays.push_back(rayThrough(settings.seed, k, vec3(0.3f, 0.2f, 0.1f)));
    PartialVolume bright = deposit(level, layout, rays);
    for (ClvRay& ray : rays) ray.flux = -ray.flux;
    PartialVolume dark = deposit(level, layout, rays);
    double differing = 0.0;
    for (std::size_t k = 0; k < bright.deposits.size(); ++k) differing += bright.deposits[k] != -dark.deposits[k];
    return {{"deposits that are not minus those of the same flux above 0", differing, 0.0}};
}

// Rays of 1 W through one cell, each followed by one of `ratio` W: the sum, beside double precision. apart: the dim ones add to sums of their own.
struct OneCell {
    double brightError = 0.0, dimError = 0.0;  // over the light of each
};
OneCell raysThroughOneCell(uint count, float ratio, bool apart, const StressSettings& settings) {
    ClvVolume volume{};
    volume.cellSize = 1.0f, volume.resolution = ivec3(1), volume.storage = kClvStorageCube;
    const Level level = buildLevel(volume, {}, {}, serialFor(), {.linesPerCell = 0, .findRegions = false});
    const DepositLayout layout{kClvStorageCube, 1};
    std::vector<ClvRay> rays, dim;
    double bright = 0.0, faint = 0.0;
    for (uint k = 0; k < count; ++k) {
        ClvRay ray{};
        ray.origin = vec3(0.0f, 0.5f, 0.5f), ray.direction = vec3(1.0f, 0.0f, 0.0f), ray.flux = vec3(1.0f);
        ray.maxDistance = clvUnitFloat(clvHashCombine(settings.seed, k));
        bright += double(ray.maxDistance);
        rays.push_back(ray);
        if (ratio == 0.0f) continue;
        ray.flux = vec3(ratio);
        faint += double(ratio) * double(ray.maxDistance);
        (apart ? dim : rays).push_back(ray);
    }
    const double sum = deposit(level, layout, rays).deposits[1], sumOfDim = apart ? double(deposit(level, layout, dim).deposits[1]) : sum - bright;
    return {std::abs((apart ? sum / bright : sum / (bright + faint)) - 1.0), faint > 0.0 ? std::abs(sumOfDim / faint - 1.0) : 0.0};
}

std::vector<StressFigure> millionRays(const StressSettings& settings) {
    const uint most = settings.exhaustive ? 1u << 26 : 1u << 22;
    std::vector<StressFigure> figures = {{"a million like rays, sum off by", raysThroughOneCell(1u << 20, 0.0f, false, settings).brightError, 1e-4},
                                         {fmt::format("{} million like rays, sum off by", most >> 20), raysThroughOneCell(most, 0.0f, false, settings).brightError, 1e-4}};
    figures.push_back({"65536 rays and as many a hundred times dimmer, % of these off", 100.0 * raysThroughOneCell(1u << 16, 1e-2f, false, settings).dimError, 0.5});
    for (uint count : {1u << 12, 1u << 16, 1u << 20}) {
        const double lost = 100.0 * raysThroughOneCell(count, 1e-3f, false, settings).dimError;
        figures.push_back({fmt::format("{} rays and as many a thousand times dimmer, % of these off", count), lost, count <= 1u << 12 ? 0.5 : StressFigure::kStated});
    }
    figures.push_back({"a million of each, in sums of their own, %", 100.0 * raysThroughOneCell(1u << 20, 1e-3f, true, settings).dimError, 0.01});
    return figures;
}

// Sums of integers with the scale that clvFixedScale gives: they hold the worst case, and lose what is below half a unit.
std::vector<StressFigure> fixedPoint(const StressSettings& settings) {
    const float cell = 0.25f;
    const uint rays = 65536u;
    double overflows = 0.0, worst = 0.0, dimLost = 0.0;
    for (float brightest : {1e-6f, 1.0f, 1e6f}) {
        const float scale = clvFixedScale(brightest, rays, clvLargestDeposit(kClvInjectTrackLength, 0u, cell));
        // The worst case: every ray crosses this one cell along its whole side.
        long long most = 0;
        for (uint k = 0; k < rays; ++k) most += clvFixedFromFloat(brightest * cell, scale);
        overflows += most > 2147483647ll;
        // A usual case, and in it the share of a lamp that is a million times dimmer.
        long long sum = 0, dim = 0;
        double exact = 0.0, exactDim = 0.0;
        for (uint k = 0; k < rays; ++k) {
            const float a = brightest * cell * clvUnitFloat(clvHashCombine(settings.seed, k)), b = 1e-6f * a;
            sum += clvFixedFromFloat(a, scale), dim += clvFixedFromFloat(b, scale);
            exact += double(a), exactDim += double(b);
        }
        worst = largerOf(worst, std::abs(double(sum) / double(scale) / exact - 1.0));
        dimLost = largerOf(dimLost, 100.0 * (1.0 - double(dim) / double(scale) / exactDim));
    }
    return {{"sums beyond 32 bits", overflows, 0.0}, {"error of the sum", worst, 2e-6}, {"of a lamp a million times dimmer, % lost", dimLost}};
}

}  // namespace

std::vector<StressCase> fluxCases() {
    return {
        {"flux", "NaN, infinite, dead and endless rays among good ones", "they add nothing, and harm nothing", badAmongGood},
        {"flux", "flux of 2^-90 to 2^90", "deposits scale with it, to the bit", linearity},
        {"flux", "flux of 1e38 and 3.4e38 W a ray, endless, cells of 1 nm to 100 km", "sums are finite, and what is read is that of the flux that is let in", brightest},
        {"flux", "flux below 0", "it takes away what flux above 0 adds", negative},
        {"flux", "millions of rays through one cell", "the sum of like rays is right within 1e-4, and of dim ones where there are few, or apart; else their loss is stated", millionRays},
        {"flux", "sums of integers, lamps of 1e-6 to 1e6 W", "no sum overflows, and none is off by more than 2e-6", fixedPoint},
    };
}

}  // namespace clv
