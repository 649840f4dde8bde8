#include "bindings/cli/scene_facts.h"

#include "bindings/scene/scene_facts.h"

namespace clv {
namespace {

constexpr std::uint64_t kManyRays = 512 << 10;  // from which on the volumes are filled in more pieces

}  // namespace

SceneFacts sceneFacts(const Scene& scene, const LightOptions& options) {
    SceneFacts facts = sceneFacts(scene);
    facts.allBounces = options.allBounces;
    facts.resolutionGiven = options.resolution > 0;
    return facts;
}

VolumeParts volumeParts(int halves, std::uint64_t rays) {
    return {.halves = halves, .chunks = rays >= kManyRays ? 4 : 2 / halves};
}

ClvVolume volumeOver(const Scene& scene, int resolution, const LightOptions& options) {
    const vec3 shift(float(options.cellShift[0]), float(options.cellShift[1]), float(options.cellShift[2]));
    return volumeOverBounds(scene.bounds.lo, scene.bounds.hi, resolution, options.storage, glm::fract(shift));
}

}  // namespace clv
