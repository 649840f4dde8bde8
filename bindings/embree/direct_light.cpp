#include "bindings/embree/direct_light.h"

#include "clv/stages/rays.h"

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

ClvRay shadowRay(const ClvLight& light, const glm::vec3& origin, float offset) {
    ClvRay ray = clvDeadRay();
    ray.origin = origin;
    if (light.type == kClvLightDirectional) {
        ray.direction = -light.direction, ray.maxDistance = kClvFar;
        return ray;
    }
    const glm::vec3 toLight = light.position - origin;
    const float distance = glm::length(toLight);
    if (!(distance > 0.0f)) return ray;
    ray.direction = toLight / distance, ray.maxDistance = glm::max(distance - offset, 0.5f * distance);
    return ray;
}

}  // namespace clv
