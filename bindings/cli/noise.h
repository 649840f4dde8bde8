// How noisy light is, by two independent estimates of it.
#pragma once
#include <span>

#include <glm/glm.hpp>

namespace clv {

// Of a point: an error of more than this share of its own light, or of a twentieth of the mean where it has less.
inline constexpr double kNoisy = 0.3;

struct Noise {
    double ofMean = 0.0;  // standard error, root mean square over points and channels, over the mean
    double noisy = 0.0;   // share of the points that are off by kNoisy
    double dark = 0.0;    // share of those that neither estimate has light for
};

// Of the mean of both estimates, as many points each.
Noise noiseOf(std::span<const glm::vec3> a, std::span<const glm::vec3> b);

}  // namespace clv
