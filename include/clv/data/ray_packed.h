// A ray in 32 bytes, for buffers and files. Golden bytes per version are kept by the tests.
//
// Exact: origin, maxDistance and the largest channel of the flux. Direction: octahedral, within 7e-5 rad.
// Other channels of the flux: within 2^-24 of the largest. Dynamicity: within 1/131070.
#ifndef CLV_DATA_RAY_PACKED_H
#define CLV_DATA_RAY_PACKED_H
#include "../math/finite.h"
#include "../math/octahedral.h"
#include "../math/pack.h"
#include "ray.h"
CLV_NAMESPACE_BEGIN

// Raised whenever the same ray gives other bits.
CLV_CONST uint kClvRayPackedVersion = 1u;

struct ClvRayPacked {  // 32 bytes, the same in C++, GLSL and HLSL
    uvec4 path;        // bits of origin.x, origin.y, origin.z and maxDistance
    uvec4 load;        // x: direction, two 16-bit snorms; yzw: flux red, green, blue in the lower 24 bits, and in the upper
                       // 8 their exponent, dynamicity's lower and dynamicity's upper half
};

CLV_FN ClvRayPacked clvPackRay(ClvRay ray) {
    vec2 square = clvOctahedralFromDirection(ray.direction);
    uvec4 flux = clvSharedExponentFromFloat(ray.flux);
    uint dynamicity = clvUnorm16FromFloat(ray.dynamicity);
    ClvRayPacked r;
    r.path = uvec4(clvBitsFromFloat(ray.origin.x), clvBitsFromFloat(ray.origin.y), clvBitsFromFloat(ray.origin.z),
                   clvBitsFromFloat(ray.maxDistance));
    r.load = uvec4(clvSnorm16FromFloat(square.x) | (clvSnorm16FromFloat(square.y) << 16), flux.x | (flux.w << 24),
                   flux.y | ((dynamicity & 0xffu) << 24), flux.z | ((dynamicity >> 8) << 24));
    return r;
}

// Any bits give a finite ray: one whose origin or distance is not finite is dead, with its origin at 0.
CLV_FN ClvRay clvUnpackRay(ClvRayPacked bits) {
    ClvRay ray;
    ray.origin = vec3(clvFloatFromBits(bits.path.x), clvFloatFromBits(bits.path.y), clvFloatFromBits(bits.path.z));
    ray.maxDistance = clvFloatFromBits(bits.path.w);
    if (!clvIsFinite(ray.origin) || !clvIsFinite(ray.maxDistance)) {
        ray.origin = vec3(0.0f, 0.0f, 0.0f);
        ray.maxDistance = 0.0f;
    }
    ray.maxDistance = max(ray.maxDistance, 0.0f);
    ray.direction = clvDirectionFromOctahedral(
        vec2(clvFloatFromSnorm16(bits.load.x), clvFloatFromSnorm16(bits.load.x >> 16)));
    ray.dynamicity = clvFloatFromUnorm16((bits.load.z >> 24) | ((bits.load.w >> 24) << 8));
    ray.flux = clvFloatFromSharedExponent(uvec4(bits.load.y, bits.load.z, bits.load.w, bits.load.y >> 24));
    ray.pad0 = 0.0f;
    return ray;
}

CLV_NAMESPACE_END
#endif
