#include "viz/plot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace clv {
namespace {

constexpr int kProbeSteps = 512;
constexpr std::size_t kBars = 32;
constexpr double kEqualExtent = 0.1;  // of the value
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
    // Of equal values the bar stands in the middle of a range that shows where.
    const double extent = most > least ? double(most - least) : kEqualExtent * std::max(1.0, std::abs(double(most)));
    const double width = extent / double(kBars), first = most > least ? double(least) : double(least) - 0.5 * extent;
    for (std::size_t k = 0; k < kBars; ++k) plot.points.emplace_back(first + (double(k) + 0.5) * width, 0.0);
    for (const float value : values) plot.points[std::min(kBars - 1, std::size_t((double(value) - first) / width))].y += 1.0;
    return plot;
}

}  // namespace clv
