#include "viz/status.h"

#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace clv {
namespace {

std::string thresholdText(float threshold) {
    if (threshold == 0.0f) return "all cells";
    return threshold == kAnyLight ? "cells with any light" : fmt::format("cells from {:.3g} W/m^2", threshold);
}

}  // namespace

std::string statusOf(const View& view, std::size_t cascades) {
    std::vector<std::string> parts;
    const bool quantity = view.subject == Subject::error || quantityOf(view.subject);
    if (showsCubes(view)) parts.push_back(thresholdText(view.threshold));
    if (quantity && carrierOf(view) == Carrier::slices) {
        for (const SlicePlane& plane : view.slices) parts.push_back(fmt::format("{} = {:.3f} m", "xyz"[plane.axis], plane.place));
    }
    if (!quantity || view.mesh) parts.push_back(fmt::format("exposure {:+.1f}", view.exposure));
    if (cascades > 1) parts.push_back(view.cascade ? fmt::format("cascade {} alone", *view.cascade) : "all cascades");
    if (!view.lookup.planeCulling) parts.push_back("no plane culling");
    if (!view.lookup.visibility) parts.push_back("no visibility");
    return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace clv
