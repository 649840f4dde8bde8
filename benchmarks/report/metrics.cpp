#include "benchmarks/report/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clv {
namespace {

constexpr std::size_t kChannels = 3;

double sumOfChannels(const glm::dvec3& v) {
    return v.x + v.y + v.z;
}

}  // namespace

double relativeTo(double a, double b) {
    if (b != 0.0) return a / b;
    return a == 0.0 ? 0.0 : std::copysign(std::numeric_limits<double>::infinity(), a);
}

double meanIrradiance(std::span<const glm::vec3> irradiance) {
    double sum = 0.0;
    for (const glm::vec3& e : irradiance) sum += sumOfChannels(e);
    return irradiance.empty() ? 0.0 : sum / double(kChannels * irradiance.size());
}

std::vector<float> pointErrors(std::span<const glm::vec3> estimate, std::span<const glm::vec3> truth) {
    double meanLength = 0.0;
    for (const glm::vec3& t : truth) meanLength += glm::length(glm::dvec3(t)) / double(truth.size());
    // Dark points are measured against a twentieth of the mean, else their noise would drown all others.
    const double floor = 0.05 * meanLength;
    std::vector<float> errors;
    errors.reserve(truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const glm::dvec3 difference = glm::dvec3(estimate[i]) - glm::dvec3(truth[i]);
        errors.push_back(float(relativeTo(glm::length(difference), std::max(glm::length(glm::dvec3(truth[i])), floor))));
    }
    return errors;
}

double percentile95(std::vector<float> values) {
    if (values.empty()) return 0.0;
    const auto rank = std::size_t(std::ceil(0.95 * double(values.size()))) - 1;
    std::ranges::nth_element(values, values.begin() + std::ptrdiff_t(rank));
    return values[rank];
}

ErrorSummary summarizeErrors(std::span<const glm::vec3> estimate, std::span<const glm::vec3> truth) {
    if (truth.empty()) return {};
    double squares = 0.0, differences = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const glm::dvec3 difference = glm::dvec3(estimate[i]) - glm::dvec3(truth[i]);
        squares += glm::dot(difference, difference);
        differences += sumOfChannels(difference);
    }
    const double count = double(kChannels * truth.size());
    const double mean = meanIrradiance(truth);
    return {relativeTo(std::sqrt(squares / count), mean), relativeTo(differences / count, mean),
            percentile95(pointErrors(estimate, truth))};
}

double leak(std::span<const glm::vec3> darkEstimate, std::span<const glm::vec3> darkTruth, std::span<const glm::vec3> litEstimate) {
    const double truth = meanIrradiance(darkTruth);
    return relativeTo(meanIrradiance(darkEstimate), truth > 0.0 ? truth : meanIrradiance(litEstimate));
}

}  // namespace clv
