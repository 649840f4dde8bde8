#include "bindings/cli/scene_facts.h"

#include <algorithm>

#include "clv/plan/direction_frame.h"

namespace clv {
namespace {

constexpr std::uint64_t kManyRays = 512 << 10;  // from which on the volumes are filled in more pieces

// Each triangle's normal, as long as its area is large, m^2.
std::vector<vec3> faceAreas(const Scene& scene) {
    std::vector<vec3> areas;
    areas.reserve(scene.triangles.size());
    for (const glm::uvec3& t : scene.triangles) {
        const vec3& corner = scene.positions[t.x];
        areas.push_back(0.5f * cross(scene.positions[t.y] - corner, scene.positions[t.z] - corner));
    }
    return areas;
}

bool isGrey(const glm::vec3& v) { return v.x == v.y && v.y == v.z; }

}  // namespace

bool sendsLight(const NamedLight& light) {
    const glm::vec3 i = light.light.intensity;
    return std::max({i.x, i.y, i.z}) > 0.0f;
}

SceneFacts sceneFacts(const Scene& scene, const LightOptions& options) {
    SceneFacts facts;
    facts.greyLights = std::ranges::all_of(scene.lights, [](const NamedLight& l) { return isGrey(l.light.intensity); });
    facts.greySurfaces = std::ranges::all_of(scene.materials, [](const Material& m) { return isGrey(m.albedo) && m.texture < 0; });
    facts.anyLight = std::ranges::any_of(scene.lights, sendsLight);
    facts.allBounces = options.allBounces;
    facts.resolutionGiven = options.resolution > 0;
    facts.frame = directionFrame(faceAreas(scene));
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
