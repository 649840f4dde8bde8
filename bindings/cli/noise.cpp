#include "bindings/cli/noise.h"

#include <algorithm>
#include <cmath>

namespace clv {

Noise noiseOf(std::span<const glm::vec3> a, std::span<const glm::vec3> b) {
    double squares = 0.0, sum = 0.0, lengths = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const glm::dvec3 error = 0.5 * (glm::dvec3(a[i]) - glm::dvec3(b[i])), mean = 0.5 * (glm::dvec3(a[i]) + glm::dvec3(b[i]));
        squares += glm::dot(error, error), sum += mean.x + mean.y + mean.z, lengths += glm::length(mean);
    }
    if (a.empty()) return {};
    if (!(sum > 0.0)) return {.dark = 1.0};
    const double count = double(a.size()), least = 0.05 * lengths / count;
    Noise noise{.ofMean = std::sqrt(3.0 * count * squares) / sum};
    for (std::size_t i = 0; i < a.size(); ++i) {
        const glm::dvec3 error = 0.5 * (glm::dvec3(a[i]) - glm::dvec3(b[i])), mean = 0.5 * (glm::dvec3(a[i]) + glm::dvec3(b[i]));
        noise.noisy += glm::length(error) > kNoisy * std::max(glm::length(mean), least) ? 1.0 / count : 0.0;
        noise.dark += a[i] == glm::vec3(0.0f) && b[i] == glm::vec3(0.0f) ? 1.0 / count : 0.0;
    }
    return noise;
}

}  // namespace clv
