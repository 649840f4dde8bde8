#include "viz/plot.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace clv {
namespace {

constexpr int kProbeSteps = 512;
constexpr std::size_t kBars = 32;
constexpr float kGap = std::numeric_limits<float>::quiet_NaN();

}  // namespace

Plot probe(const BakedVolume& volume, Quantity quantity, ShownCascade only, const vec3& from, const vec3& to) {
    Plot plot{fmt::format("along a line of {:.3g} m", glm::length(to - from)), "distance, m", titleOf(quantity), {}, false};
    for (int i = 0; i <= kProbeSteps; ++i) {
        const float share = float(i) / kProbeSteps;
        const auto cell = cellAt(volume, mix(from, to, share), only);
        plot.points.emplace_back(double(share) * double(glm::length(to - from)), cell ? valueOf(*cell, quantity) : kGap);
    }
    return plot;
}

Plot histogram(const BakedVolume& volume, Quantity quantity, ShownCascade only, const ParallelFor& parallelFor) {
    std::vector<float> values;
    for (const ShownCell& cell : shownCells(volume, only, parallelFor)) values.push_back(valueOf(cell, quantity));
    Plot plot{fmt::format("{} cells", values.size()), titleOf(quantity), "cells", {}, true};
    if (values.empty()) return plot;
    const auto [least, most] = std::ranges::minmax(values);
    const double width = std::max(double(most - least), 1e-30) / double(kBars);
    for (std::size_t k = 0; k < kBars; ++k) plot.points.emplace_back(least + (double(k) + 0.5) * width, 0.0);
    for (const float value : values) plot.points[std::min(kBars - 1, std::size_t((value - least) / width))].y += 1.0;
    return plot;
}

}  // namespace clv
