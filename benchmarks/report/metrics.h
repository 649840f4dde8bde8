// How far an estimate is from the truth, in the numbers that every tool of this project quotes.
#pragma once
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace clv {

// All relative, 1 = 100 %. Where the truth is zero everywhere, a relative number is 0 for a perfect estimate, else infinite.
struct ErrorSummary {
    double relativeRmse = 0.0;  // sqrt(mean((E - T)^2)) / mean(T) over points and channels
    double bias = 0.0;          // mean(E - T) / mean(T)
    double p95 = 0.0;           // 95th percentile (nearest rank) over points of pointErrors()
};

// Spans of the same size: irradiance, W/m^2, linear RGB.
ErrorSummary summarizeErrors(std::span<const glm::vec3> estimate, std::span<const glm::vec3> truth);

// |E - T| / max(|T|, 0.05 mean |T|) a point, lengths of RGB vectors.
std::vector<float> pointErrors(std::span<const glm::vec3> estimate, std::span<const glm::vec3> truth);

// The smallest value that at least 95 % of the values do not exceed; 0 for none.
double percentile95(std::vector<float> values);

// Light on the dark side of a wall: the mean estimate there over the mean truth there; where no light should be at all, over
// the mean estimate on the lit side.
double leak(std::span<const glm::vec3> darkEstimate, std::span<const glm::vec3> darkTruth, std::span<const glm::vec3> litEstimate);

// Mean over points and channels, W/m^2; 0 for no points.
double meanIrradiance(std::span<const glm::vec3> irradiance);

// a / b, with 0 / 0 = 0 and a / 0 infinite.
double relativeTo(double a, double b);

}  // namespace clv
