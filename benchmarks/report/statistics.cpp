#include "benchmarks/report/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "clv/math/constants.h"

namespace clv {
namespace {

constexpr double kConfidence = 0.95;

// Probability that |t| <= x (Abramowitz and Stegun 1964, equations 26.7.3 and 26.7.4).
double studentWithin(double x, int degrees) {
    const double angle = std::atan(x / std::sqrt(double(degrees))), sine = std::sin(angle), cosine = std::cos(angle);
    const bool odd = degrees % 2 == 1;
    double term = odd ? cosine : 1.0, sum = degrees == 1 ? 0.0 : term;
    for (int k = odd ? 3 : 2; k < degrees; k += 2) {
        term *= cosine * cosine * (k - 1.0) / k;
        sum += term;
    }
    return odd ? 2.0 / double(kClvPi) * (angle + sine * sum) : sine * sum;
}

}  // namespace

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values.empty() ? 0.0 : values[values.size() / 2];
}

double middleHalf(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values.empty() ? 0.0 : values[(3 * values.size() - 1) / 4] - values[values.size() / 4];
}

double studentQuantile(double confidence, int degreesOfFreedom) {
    if (degreesOfFreedom < 1) return std::numeric_limits<double>::infinity();
    double below = 0.0, above = 1.0;
    while (studentWithin(above, degreesOfFreedom) < confidence) above *= 2.0;
    constexpr int kHalvings = 60;  // to the last bits of a double
    for (int i = 0; i < kHalvings; ++i) {
        const double middle = 0.5 * (below + above);
        (studentWithin(middle, degreesOfFreedom) < confidence ? below : above) = middle;
    }
    return above;
}

RootMeanSquare rootMeanSquare(const std::vector<double>& values) {
    if (values.empty()) return {};
    const double count = double(values.size());
    double mean = 0.0, spread = 0.0;
    for (const double v : values) mean += v * v / count;
    for (const double v : values) spread += (v * v - mean) * (v * v - mean);
    const double root = std::sqrt(mean);
    if (values.size() < 2) return {root, std::numeric_limits<double>::infinity()};
    const double standardError = std::sqrt(spread / (count - 1.0) / count);
    // d sqrt(m) = dm / (2 sqrt(m)).
    return {root, root > 0.0 ? studentQuantile(kConfidence, int(values.size()) - 1) * standardError / (2.0 * root) : 0.0};
}

}  // namespace clv
