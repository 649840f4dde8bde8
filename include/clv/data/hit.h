// What a ray met at its end.
#ifndef CLV_DATA_HIT_H
#define CLV_DATA_HIT_H
#include "../lang.h"
CLV_NAMESPACE_BEGIN

CLV_CONST uint kClvNoPrimitive = 0xffffffffu;

struct ClvHit {       // 32 bytes
    vec3 normal;      // unit length, turned against the ray; 0 where nothing was hit
    float distance;   // m; kClvFar where nothing was hit
    vec3 albedo;      // linear RGB, [0, 1]
    uint primitive;   // triangle index; kClvNoPrimitive where nothing was hit
};

CLV_NAMESPACE_END
#endif
