#include "viz/truth_error.h"

#include <algorithm>

#include "benchmarks/report/metrics.h"

namespace clv {

double medianError(std::span<const float> standardErrors, std::span<const glm::vec3> truth) {
    if (truth.empty()) return 0.0;
    double mean = 0.0;
    for (const glm::vec3& e : truth) mean += double(glm::length(e)) / double(truth.size());
    std::vector<double> shares;
    for (std::size_t i = 0; i < truth.size(); ++i) shares.push_back(relativeTo(double(standardErrors[i]), std::max(double(glm::length(truth[i])), 0.05 * mean)));
    const auto middle = shares.begin() + std::ptrdiff_t(shares.size() / 2);
    std::ranges::nth_element(shares, middle);
    return *middle;
}

}  // namespace clv
