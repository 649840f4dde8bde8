// A light as glTF's KHR_lights_punctual has it, in radiometric units.
#ifndef CLV_DATA_LIGHT_H
#define CLV_DATA_LIGHT_H
#include "../math/constants.h"
CLV_NAMESPACE_BEGIN

CLV_CONST uint kClvLightPoint = 0u;
CLV_CONST uint kClvLightSpot = 1u;
CLV_CONST uint kClvLightDirectional = 2u;

struct ClvLight {          // 64 bytes
    vec3 position;         // m; unused by directional lights
    uint type;             // kClvLight...
    vec3 direction;        // unit length, the way the light travels; unused by point lights
    float innerConeAngle;  // rad, [0, outerConeAngle); spot lights only
    vec3 intensity;        // linear RGB; W/sr for point and spot, W/m^2 on a plane that faces a directional light
    float outerConeAngle;  // rad, (innerConeAngle, pi/2]; spot lights only
    float dynamicity;      // [0, 1]; 0: the light stands still
    float pad0;
    float pad1;
    float pad2;
};

// Fraction of the intensity that a spot light sends along `direction` (unit length), [0, 1].
// KHR_lights_punctual: the square of a ramp that is linear in the cosine between the two cones.
CLV_FN float clvSpotFalloff(float cosAngle, float innerConeAngle, float outerConeAngle) {
    float cosOuter = cos(outerConeAngle);
    float scale = 1.0f / max(0.001f, cos(innerConeAngle) - cosOuter);
    float ramp = clamp((cosAngle - cosOuter) * scale, 0.0f, 1.0f);
    return ramp * ramp;
}

CLV_NAMESPACE_END
#endif
