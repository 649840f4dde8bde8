// Figures of repeated measurements.
#pragma once
#include <span>
#include <vector>

namespace clv {

// Of the intervals that are stated.
inline constexpr double kConfidence = 0.95;

// 0 for no values; the upper of the two in the middle.
double median(std::vector<double> values);

// Distance between the quarters: what the middle half of the values spans.
double middleHalf(std::vector<double> values);

// Value that a Student-distributed variable exceeds in magnitude with the probability 1 - confidence; infinite without a degree of freedom.
double studentQuantile(double confidence, int degreesOfFreedom);

// A root mean square of independent values, and the half width of the interval that holds the true one with 95 % confidence;
// infinite for a single value.
struct RootMeanSquare {
    double value = 0.0, interval = 0.0;
};
RootMeanSquare rootMeanSquare(const std::vector<double>& values);

// y = at0 + slope * x, least squares; at least two different x.
struct Line {
    double at0 = 0.0, slope = 0.0;
};
Line fitLine(std::span<const double> x, std::span<const double> y);

// y = factor * x^exponent, fitted to positive numbers in logarithms; at least two different x.
struct PowerLaw {
    double factor = 0.0, exponent = 0.0;
    double interval = 0.0;  // half width, 95 %, of the exponent; infinite for two pairs
};
PowerLaw fitPowerLaw(std::span<const double> x, std::span<const double> y);

}  // namespace clv
