// The chi-square test: do counts follow their expectations?
#ifndef CLV_TESTS_SUPPORT_CHI_SQUARE_H
#define CLV_TESTS_SUPPORT_CHI_SQUARE_H
#include <cmath>
#include <span>

#include "clv/math/hash.h"
#include "clv/math/sampling.h"

namespace clv::test {

// Chance that a chi-square variable with an even number of degrees of freedom exceeds `statistic`:
// exp(-x/2) sum_{i < k/2} (x/2)^i / i!, which is exact for even k.
inline double chiSquareTail(double statistic, int degrees) {
    double half = 0.5 * statistic, tail = 0.0;
    for (int i = 0; i < degrees / 2; ++i) tail += std::exp(i * std::log(half) - half - std::lgamma(i + 1.0));
    return tail;
}

// Chance that counts at least as far from `expected` as these come from it. The number of bins is odd, its total fixed.
inline double chiSquareChance(std::span<const double> counts, std::span<const double> expected) {
    double statistic = 0.0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        double difference = counts[i] - expected[i];
        statistic += difference * difference / expected[i];
    }
    return chiSquareTail(statistic, int(counts.size()) - 1);
}

// An independent number in [0, 1).
inline float randomUnit(uint seed, uint index) { return clvUnitFloat(clvHashCombine(clvHash(seed), index)); }

inline vec3 randomDirection(uint seed, uint index) {
    return clvSphereFromSquare(vec2(randomUnit(seed, 2u * index), randomUnit(seed, 2u * index + 1u)));
}

}  // namespace clv::test
#endif
