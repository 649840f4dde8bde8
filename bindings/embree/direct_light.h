// Light that comes straight from a lamp.
#pragma once
#include <glm/glm.hpp>

#include "clv/data/light.h"

namespace clv {

// What a light sends to a point if nothing stands between.
struct DirectLight {
    glm::vec3 towardsLight;  // unit length
    float distance;          // m; kClvFar for a directional light
    glm::vec3 irradiance;    // W/m^2, linear RGB, on a plane that faces the light
};

DirectLight directLightAt(const ClvLight& light, const glm::vec3& position);

}  // namespace clv
