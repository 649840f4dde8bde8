#include "bindings/cli/heed_lights.h"

#include <fmt/format.h>

#include "bindings/cli/surroundings.h"
#include "bindings/embree/light_check.h"
#include "bindings/embree/light_maps.h"
#include "clv/plan/largest_flux.h"
#include "clv/stages/inject.h"

namespace clv {

namespace {

constexpr double kDim = 1e-3;       // share of all light below which a light counts as dim,
constexpr double kFewRays = 100.0;  // and rays, with which it is noise where it alone shines

void heedDimLights(const LightCheck& check, const std::vector<NamedLight>& lights, double rays, std::vector<std::string>& warnings) {
    if (rays == 0.0) return;
    std::size_t dim = 0, first = 0;
    for (std::size_t k = check.shares.size(); k-- > 0;) {
        if (check.shares[k] > 0.0 && check.shares[k] < kDim && check.shares[k] * rays < kFewRays) ++dim, first = k;
    }
    if (dim == 0) return;
    warnings.push_back(fmt::format("light \"{}\"{} so little of all light that about {:.2g} of the rays carry its: where nothing else shines there is noise, or nothing",
                                   lights[first].name, dim > 1 ? fmt::format(" and {} more send", dim - 1) : " sends", check.shares[first] * rays));
}

}  // namespace

std::vector<std::string> heedNearLights(const EmbreeScene& scene, std::span<const ReferencePoint> points, double paths, const ParallelFor& parallelFor) {
    constexpr double kFewPaths = 10.0, kNear = 0.1;  // paths; of the distance from which points see surfaces
    const LightCheck check = checkLights(scene, parallelFor);
    const double sight = nearSight(lookAround(scene, receiversOf(points), parallelFor));
    std::vector<std::string> warnings;
    for (std::size_t k = 0; k < check.reach.size(); ++k) {
        // A lamp on a surface lights what it sees, and no spot.
        const double reach = check.reach[k], met = paths * 0.25 * reach * reach / (sight * sight);
        if (check.shares[k] < kDim || reach <= 2.0 * double(scene.surfaceOffset()) || reach > kNear * sight || sight >= double(kClvFar)) continue;
        if (met < kFewPaths)
            warnings.push_back(fmt::format("light \"{}\" sends a quarter of its light to surfaces within {:.2g} m: about {:.2g} of {:.0f} paths meet them, and the "
                                           "standard error does not show what is missed",
                                           scene.scene().lights[k].name, reach, met, paths));
    }
    return warnings;
}

LightHeed heedLights(const EmbreeScene& scene, float cellSize, double rays, const ParallelFor& parallelFor) {
    constexpr double kStray = 0.05;  // share of the light that may fall on backs without a word: on sheets, and through cracks
    const LightCheck check = checkLights(scene, parallelFor);
    LightHeed heed{.warnings = {}, .insideOut = check.shareOnBacks > 0.5};
    for (const std::string& name : check.idle) {
        heed.warnings.push_back(fmt::format("light \"{}\" meets no surface: it is too far away, or looks the other way", name));
    }
    heedDimLights(check, scene.scene().lights, rays, heed.warnings);
    const float most = clvMostFlux(kClvInjectTrackLength, cellSize);
    const Bounds& bounds = scene.scene().bounds;
    if (!(largestRayFlux(lightsThatSend(scene.scene()), bounds.lo, bounds.hi) <= most)) {
        heed.warnings.push_back(fmt::format("the lights send more than the {:g} W that cells of this size can add up: what is beyond is cut off", most));
    }
    if (heed.insideOut) heed.warnings.push_back("most of the light falls on the backs of surfaces: all of them are taken to face the other way");
    const double onBacks = heed.insideOut ? 1.0 - check.shareOnBacks : check.shareOnBacks;
    heed.sheets = onBacks > kStray;
    if (heed.sheets) heed.warnings.push_back(fmt::format("{:.0f} % of the light falls on the backs of surfaces: nothing counts as solid", 100.0 * onBacks));
    return heed;
}

}  // namespace clv
