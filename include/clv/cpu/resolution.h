// Which level, or which mix of levels, errs least: judged without a truth, by two independent halves of the rays.
//
// Level l gives the estimates A_l and B_l at the same receivers, from the two halves. Their mean is what is shown, and
//   noise:  E[(A_l - B_l) (A_m - B_m)] / 4            is the covariance of the shown values of levels l and m,
//   bias:   E[(A_l - A_f) (B_m - B_f)]                is the product of their biases against the finest level f; A and B are
//                                                     independent, so noise does not enter it.
// Halves that are stretches of one low-discrepancy sequence are not quite independent: what they share out evenly makes the noise look
// a little larger and the bias smaller by as much, so that a coarser level is preferred where two are nearly level.
// The mean squared error of sum(c_l * level l) with sum(c) = 1 is c' (bias + noise) c. With more rays of the same kind the noise falls
// as their number, so errors can be foretold.
//
// Shown is the mix of the best level and its neighbours that errs least. Where levels are nearly level, and the judgement could go
// either way, it gives to each its part; levels further away are left out, since a mix of many follows the noise of the judgement
// itself.
#ifndef CLV_CPU_RESOLUTION_H
#define CLV_CPU_RESOLUTION_H
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "../stages/evaluate.h"

namespace clv {

inline constexpr int kMostLevels = 6;

// Resolutions to choose from, coarse to fine.
inline constexpr int kResolutions[] = {8, 16, 32, 64, 128};

// Those that are worth trying with so many rays. The coarsest errs least, or helps the next one in a mix, as long as noise hides what its
// large cells blur; with more rays it would be filled for nothing.
// lookup: kClvLookup...; without the linear fit large cells blur more, and only with far fewer rays does noise hide it.
inline std::span<const int> resolutionsFor(double rays, uint lookup = kClvLookupLinearFit) {
    const double fewRays = lookup == kClvLookupLinearFit ? 512 << 10 : 8 << 10;
    return std::span(kResolutions).subspan(rays < fewRays ? 0 : 1);
}

// What one level says at the receivers, W/m^2.
struct HalfEstimates {
    std::vector<vec3> half[2];
};

// Symmetric matrices over the levels, coarse to fine, (W/m^2)^2, means over receivers and channels.
struct LevelErrors {
    int count = 0;
    std::array<std::array<double, kMostLevels>, kMostLevels> noise{}, bias{};

    double meanSquare(std::span<const double> mix) const {
        double sum = 0.0;
        for (int l = 0; l < count; ++l)
            for (int m = 0; m < count; ++m) sum += mix[l] * mix[m] * (bias[l][m] + noise[l][m]);
        return sum;
    }
    // Of the difference between the biases of two levels. Only their own noise enters it, not that of levels finer than both.
    double biasBetween(int l, int m) const { return bias[l][l] + bias[m][m] - 2.0 * bias[l][m]; }
    // The mean squared error of a level over that of the next finer one, the bias that both may share left aside.
    double overNextFiner(int l) const { return (biasBetween(l, l + 1) + noise[l][l]) / noise[l + 1][l + 1]; }

    // Levels first to last alone, their biases against the last one.
    LevelErrors between(int first, int last) const {
        LevelErrors part;
        part.count = last - first + 1;
        for (int l = 0; l < part.count; ++l) {
            for (int m = 0; m < part.count; ++m) {
                part.noise[l][m] = noise[first + l][first + m];
                part.bias[l][m] = bias[first + l][first + m] - bias[first + l][last] - bias[last][first + m] + bias[last][last];
            }
        }
        return part;
    }
    // The same, if level l had factor[l] times as many rays.
    LevelErrors withRays(std::span<const double> factor) const {
        LevelErrors later = *this;
        for (int l = 0; l < count; ++l)
            for (int m = 0; m < count; ++m) later.noise[l][m] /= std::sqrt(factor[l] * factor[m]);
        return later;
    }
};

// Levels coarse to fine; all hold as many receivers.
inline LevelErrors judgeLevels(std::span<const HalfEstimates> levels) {
    LevelErrors errors;
    errors.count = int(levels.size());
    const HalfEstimates& finest = levels.back();
    const std::size_t receivers = finest.half[0].size();
    const double scale = 1.0 / (3.0 * double(std::max<std::size_t>(receivers, 1)));
    for (int l = 0; l < errors.count; ++l) {
        for (int m = l; m < errors.count; ++m) {
            double noise = 0.0, bias = 0.0;
            for (std::size_t i = 0; i < receivers; ++i) {
                const vec3 a = levels[l].half[0][i], b = levels[l].half[1][i], c = levels[m].half[0][i], d = levels[m].half[1][i];
                noise += dot(a - b, c - d);
                // Both ways round, so that the matrix is symmetric.
                bias += dot(a - finest.half[0][i], d - finest.half[1][i]) + dot(b - finest.half[1][i], c - finest.half[0][i]);
            }
            errors.noise[l][m] = errors.noise[m][l] = 0.25 * noise * scale;
            errors.bias[l][m] = errors.bias[m][l] = 0.5 * bias * scale;
        }
    }
    return errors;
}

namespace detail {

// Solves the symmetric system m x = 1 over the levels in `subset` by Gaussian elimination and scales x to sum 1. False if singular.
inline bool solveMix(const LevelErrors& errors, unsigned subset, std::array<double, kMostLevels>& mix) {
    int index[kMostLevels], n = 0;
    for (int l = 0; l < errors.count; ++l) {
        if (subset >> l & 1u) index[n++] = l;
    }
    double a[kMostLevels][kMostLevels + 1];
    for (int r = 0; r < n; ++r) {
        for (int c = 0; c < n; ++c) a[r][c] = errors.bias[index[r]][index[c]] + errors.noise[index[r]][index[c]];
        a[r][n] = 1.0;
    }
    for (int k = 0; k < n; ++k) {
        int pivot = k;
        for (int r = k + 1; r < n; ++r) {
            if (std::abs(a[r][k]) > std::abs(a[pivot][k])) pivot = r;
        }
        if (!(std::abs(a[pivot][k]) > 1e-300)) return false;
        for (int c = 0; c <= n; ++c) std::swap(a[k][c], a[pivot][c]);
        for (int r = 0; r < n; ++r) {
            if (r == k) continue;
            const double factor = a[r][k] / a[k][k];
            for (int c = k; c <= n; ++c) a[r][c] -= factor * a[k][c];
        }
    }
    double sum = 0.0;
    mix.fill(0.0);
    for (int k = 0; k < n; ++k) sum += mix[index[k]] = a[k][n] / a[k][k];
    if (!(std::abs(sum) > 1e-300)) return false;
    for (double& w : mix) w /= sum;
    return true;
}

}  // namespace detail

using LevelMix = std::array<double, kMostLevels>;

// The mix of levels that errs least. Weights sum to 1; each is 0 or at least kLeastWeight, below which a level is not worth reading.
inline LevelMix bestMix(const LevelErrors& errors) {
    constexpr double kLeastWeight = 0.05;
    LevelMix best{};
    double least = 1e300;
    for (unsigned subset = 1; subset < (1u << errors.count); ++subset) {
        LevelMix mix;
        if (!detail::solveMix(errors, subset, mix)) continue;
        if (std::any_of(mix.begin(), mix.end(), [](double w) { return w < kLeastWeight && w != 0.0; })) continue;
        const double error = errors.meanSquare(mix);
        if (error < least) least = error, best = mix;
    }
    if (least == 1e300) best[errors.count - 1] = 1.0;  // no light at all
    return best;
}

// Climbs from the coarsest level as long as the next finer one errs less. Comparing neighbours keeps the noise of levels that are far
// too fine out of the judgement of coarse ones.
inline int bestLevel(const LevelErrors& errors) {
    int best = 0;
    while (best + 1 < errors.count && errors.overNextFiner(best) > 1.0) ++best;
    return best;
}

// Whether a level is the best one or a neighbour of it that errs little more, so that more rays may yet turn the judgement.
inline bool staysInPlay(const LevelErrors& errors, int level) {
    constexpr double kLittleMore = 2.0;  // times the mean squared error
    const int best = bestLevel(errors);
    if (level == best + 1) return errors.overNextFiner(best) * kLittleMore > 1.0;
    if (level == best - 1) return errors.overNextFiner(level) < kLittleMore;
    return level == best;
}

// What to show: the best level and its neighbours, mixed.
inline LevelMix chooseLevels(const LevelErrors& errors) {
    const int best = bestLevel(errors), first = std::max(best - 1, 0), last = std::min(best + 1, errors.count - 1);
    const LevelMix part = bestMix(errors.between(first, last));
    LevelMix mix{};
    std::copy_n(part.begin(), last - first + 1, mix.begin() + first);
    return mix;
}

}  // namespace clv
#endif
