#include "bindings/embree/direct_light.h"

namespace clv {

DirectLight directLightAt(const ClvLight& light, const glm::vec3& position) {
    if (light.type == kClvLightDirectional) {
        return {.towardsLight = -light.direction, .distance = kClvFar, .irradiance = light.intensity};
    }
    const glm::vec3 toLight = light.position - position;
    const float distance = glm::length(toLight);
    // A point in the very place of the lamp has no direction to it.
    if (!(distance > 0.0f)) return {.towardsLight = glm::vec3(0, 1, 0), .distance = 0.0f, .irradiance = glm::vec3(0.0f)};
    const glm::vec3 towardsLight = toLight / distance;
    const float falloff = light.type == kClvLightSpot
                              ? clvSpotFalloff(-glm::dot(towardsLight, light.direction), light.innerConeAngle, light.outerConeAngle)
                              : 1.0f;
    // Divided twice: the square of a short distance would underflow.
    return {.towardsLight = towardsLight, .distance = distance, .irradiance = light.intensity * falloff / distance / distance};
}

}  // namespace clv
