#include "bindings/cli/heed_lights.h"

#include <fmt/format.h>

#include "bindings/embree/light_check.h"
#include "bindings/embree/light_maps.h"
#include "clv/plan/largest_flux.h"
#include "clv/stages/inject.h"

namespace clv {

LightHeed heedLights(const EmbreeScene& scene, float cellSize, const ParallelFor& parallelFor) {
    constexpr double kStray = 0.05;  // share of the light that may fall on backs without a word: on sheets, and through cracks
    const LightCheck check = checkLights(scene, parallelFor);
    LightHeed heed{.warnings = {}, .insideOut = check.shareOnBacks > 0.5};
    for (const std::string& name : check.idle) {
        heed.warnings.push_back(fmt::format("light \"{}\" meets no surface: it is too far away, or looks the other way", name));
    }
    const float most = clvMostFlux(kClvInjectTrackLength, cellSize);
    const Bounds& bounds = scene.scene().bounds;
    if (!(largestRayFlux(lightsThatSend(scene.scene()), bounds.lo, bounds.hi) <= most)) {
        heed.warnings.push_back(fmt::format("the lights send more than the {:g} W that cells of this size can add up: what is beyond is cut off", most));
    }
    if (heed.insideOut) {
        heed.warnings.push_back("most of the light falls on the backs of surfaces: all of them are taken to face the other way");
    } else if (check.shareOnBacks > kStray) {
        heed.warnings.push_back(fmt::format(
            "{:.0f} % of the light falls on the backs of surfaces; what is enclosed by backs counts as solid, and its light is lost", 100.0 * check.shareOnBacks));
    }
    return heed;
}

}  // namespace clv
