#include "bindings/cli/heed_lights.h"

#include <fmt/format.h>

#include "bindings/embree/light_check.h"

namespace clv {

LightHeed heedLights(const EmbreeScene& scene, const ParallelFor& parallelFor) {
    constexpr double kStray = 0.05;  // share of the light that may fall on backs without a word: on sheets, and through cracks
    const LightCheck check = checkLights(scene, parallelFor);
    LightHeed heed{.warnings = {}, .insideOut = check.shareOnBacks > 0.5};
    for (const std::string& name : check.idle) {
        heed.warnings.push_back(fmt::format("light \"{}\" meets no surface: it is too far away, or looks the other way", name));
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
