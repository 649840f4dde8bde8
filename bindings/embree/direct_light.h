// Light that comes straight from a lamp.
#pragma once
#include <glm/glm.hpp>

#include "clv/data/light.h"
#include "clv/data/ray.h"

namespace clv {

// What a light sends to a point if nothing stands between.
struct DirectLight {
    glm::vec3 towardsLight;  // unit length
    float distance;          // m; kClvFar for a directional light
    glm::vec3 irradiance;    // W/m^2, linear RGB, on a plane that faces the light
};

DirectLight directLightAt(const ClvLight& light, const glm::vec3& position);

// What must be free for the light to arrive: from `origin`, a surface's point moved off it by `offset` (m), to as far before the light, since a
// lamp may lie on a surface. It carries no flux.
ClvRay shadowRay(const ClvLight& light, const glm::vec3& origin, float offset);

}  // namespace clv
