#include "bindings/scene/scene_facts.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "clv/plan/direction_frame.h"

namespace clv {
namespace {

// In units in the last place of the scene's largest coordinate: a hit point is a sum of products with some five roundings. Rays from
// random triangles met their own surface again at 2 units and never at 4.
constexpr float kOffsetInUlps = 8.0f;

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

float surfaceOffset(const Bounds& bounds) {
    const glm::vec3 reach = glm::max(glm::abs(bounds.lo), glm::abs(bounds.hi));
    return kOffsetInUlps * std::numeric_limits<float>::epsilon() * std::max({reach.x, reach.y, reach.z});
}

SceneFacts sceneFacts(const Scene& scene) {
    SceneFacts facts;
    facts.greyLights = std::ranges::all_of(scene.lights, [](const NamedLight& l) { return isGrey(l.light.intensity); });
    facts.greySurfaces = std::ranges::all_of(scene.materials, [](const Material& m) { return isGrey(m.albedo) && m.texture < 0; });
    facts.anyLight = std::ranges::any_of(scene.lights, sendsLight);
    facts.frame = directionFrame(faceAreas(scene));
    return facts;
}

}  // namespace clv
