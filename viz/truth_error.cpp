#include "viz/truth_error.h"

#include <algorithm>

#include "benchmarks/report/metrics.h"

namespace clv {

double medianError(std::span<const float> standardErrors, std::span<const glm::vec3> truth) {
    double mean = 0.0;
    for (const glm::vec3& e : truth) mean += double(glm::length(e)) / double(truth.size());
    std::vector<double> shares;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const double length = double(glm::length(truth[i]));
        if (length > 0.0) shares.push_back(relativeTo(double(standardErrors[i]), std::max(length, 0.05 * mean)));
    }
    if (shares.empty()) return 0.0;
    const auto middle = shares.begin() + std::ptrdiff_t(shares.size() / 2);
    std::ranges::nth_element(shares, middle);
    return *middle;
}

}  // namespace clv
