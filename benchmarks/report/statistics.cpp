#include "benchmarks/report/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "clv/math/constants.h"

namespace clv {
namespace {

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

Line fitLine(std::span<const double> x, std::span<const double> y) {
    const double n = double(x.size());
    double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) sx += x[i], sy += y[i], sxx += x[i] * x[i], sxy += x[i] * y[i];
    const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
    return {(sy - slope * sx) / n, slope};
}

PowerLaw fitPowerLaw(std::span<const double> x, std::span<const double> y) {
    const std::size_t n = x.size();
    std::vector<double> logX, logY;
    double mean = 0.0;
    for (std::size_t i = 0; i < n; ++i) logX.push_back(std::log(x[i])), logY.push_back(std::log(y[i])), mean += logX.back() / double(n);
    const Line line = fitLine(logX, logY);
    double left = 0.0, spread = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        left += std::pow(logY[i] - line.at0 - line.slope * logX[i], 2.0);
        spread += (logX[i] - mean) * (logX[i] - mean);
    }
    PowerLaw law{std::exp(line.at0), line.slope, std::numeric_limits<double>::infinity()};
    if (n > 2) law.interval = studentQuantile(kConfidence, int(n) - 2) * std::sqrt(left / (double(n) - 2.0) / spread);
    return law;
}

}  // namespace clv
