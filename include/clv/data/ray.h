// The ray: a segment of light on its way from a lit surface to the first surface that it hits.
#ifndef CLV_DATA_RAY_H
#define CLV_DATA_RAY_H
#include "../math/constants.h"
CLV_NAMESPACE_BEGIN

struct ClvRay {         // 48 bytes, the same in C++, GLSL and HLSL
    vec3 origin;        // m, relative to the anchor
    float maxDistance;  // m, >= 0; kClvFar until traced, then the distance to the first hit; 0 for a ray that is dead
    vec3 direction;     // unit length, the way the light travels
    float dynamicity;   // [0, 1], from the light that emitted it
    vec3 flux;          // W, linear RGB
    float pad0;
};

CLV_NAMESPACE_END
#endif
