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

namespace clv {
namespace {

constexpr int kSide = 8;  // cells

Level openLevel() {
    ClvVolume volume{};
    volume.origin = vec3(-2.0f), volume.cellSize = 0.5f, volume.resolution = ivec3(kSide), volume.storage = kClvStorageCube9;
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
        notFinite += !std::isfinite(a);
        worst = std::max(worst, std::abs(a - b)), largest = std::max(largest, std::abs(b));
    }
    // The order of the sums differs, by the rays between them.
    return {{"deposits that are not finite", notFinite, 0.0}, {"what bad rays add, of the largest deposit", worst / largest, 1e-5}};
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

// Rays of 1e38 W: what is read must be finite, or the sum itself is beyond the floats.
std::vector<StressFigure> brightest(const StressSettings& settings) {
    const Level level = openLevel();
    const DepositLayout layout;
    std::vector<ClvRay> rays;
    for (uint k = 0; k < 16; ++k) rays.push_back(rayThrough(settings.seed, k, vec3(1e37f)));
    PartialVolume partial = deposit(level, layout, rays);
    double notFinite = 0.0, negative = 0.0;
    for (float value : partial.target().deposits) notFinite += !std::isfinite(value);
    SlotWeights weights;
    for (uint k = 0; k < 500; ++k) {
        const ClvRay at = rayThrough(settings.seed + 1u, k, vec3(1.0f));
        lookupWeights(level, {at.origin, 0.0f, at.direction, 0.0f}, {}, weights);
        const vec3 e = readIrradiance(layout, partial.target().deposits, weights, layout.read(at.direction));
        notFinite += !std::isfinite(e.x), negative += e.x < 0.0f;
    }
    return {{"values that are not finite", notFinite, 0.0}, {"irradiances below 0", negative, 0.0}};
}

// One cell that a million rays of about 1 W cross, alone and beside as many dim ones: what float32 sums keep, against double precision. Rays
// that this library draws carry equal flux, and a dim lamp fewer of them; an engine's own may not.
std::vector<StressFigure> millionRays(const StressSettings& settings) {
    std::vector<StressFigure> figures;
    for (float ratio : {0.0f, 1e-3f, 1e-6f}) {
        float sum = 0.0f;
        double bright = 0.0, dim = 0.0;
        for (uint k = 0; k < 1u << 20; ++k) {
            const float a = clvUnitFloat(clvHashCombine(settings.seed, 2 * k)), b = ratio * clvUnitFloat(clvHashCombine(settings.seed, 2 * k + 1));
            sum += a, sum += b;
            bright += double(a), dim += double(b);
        }
        if (ratio == 0.0f) figures.push_back({"error of the sum of like rays", std::abs(double(sum) / bright - 1.0), 1e-4});
        else figures.push_back({fmt::format("rays of {:g} W, error over their light, %", ratio), 100.0 * std::abs(double(sum) - bright - dim) / dim});
    }
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
        worst = std::max(worst, std::abs(double(sum) / double(scale) / exact - 1.0));
        dimLost = std::max(dimLost, 100.0 * (1.0 - double(dim) / double(scale) / exactDim));
    }
    return {{"sums beyond 32 bits", overflows, 0.0}, {"error of the sum", worst, 1e-4}, {"of a lamp a million times dimmer, % lost", dimLost}};
}

}  // namespace

std::vector<StressCase> fluxCases() {
    return {
        {"flux", "NaN, infinite, dead and endless rays among good ones", "they add nothing, and harm nothing", badAmongGood},
        {"flux", "flux of 2^-90 to 2^90", "deposits scale with it, to the bit", linearity},
        {"flux", "flux of 1e37 W a ray", "what is read is finite and not negative", brightest},
        {"flux", "a million rays through one cell", "the sum of like rays is right within 1e-4; what dim ones lose is stated", millionRays},
        {"flux", "sums of integers, lamps of 1e-6 to 1e6 W", "no sum overflows, and none is off by more than 1e-4", fixedPoint},
    };
}

}  // namespace clv
