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
    vec3 flux;          // W, linear RGB; what a level cannot add up is cut off, see clvMostFlux
    float pad0;
};

// A ray from the three rows of four numbers that it is in a texel buffer.
CLV_FN ClvRay clvRayFromRows(vec4 a, vec4 b, vec4 c) {
    ClvRay ray;
    ray.origin = vec3(a.x, a.y, a.z);
    ray.maxDistance = a.w;
    ray.direction = vec3(b.x, b.y, b.z);
    ray.dynamicity = b.w;
    ray.flux = vec3(c.x, c.y, c.z);
    ray.pad0 = c.w;
    return ray;
}

CLV_NAMESPACE_END
#endif
