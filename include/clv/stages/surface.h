// From the triangle that a walk met to the hit of the trace stage.
//
// A shader defines, before it includes this: vec4 clvReadSurface(uint row).
#ifndef CLV_STAGES_SURFACE_H
#define CLV_STAGES_SURFACE_H
#include "../data/surface.h"
#include "trace.h"
CLV_NAMESPACE_BEGIN

// The hit at `distance` (m) on a triangle of the scene, without its texture; clvNoHit() for kClvNoPrimitive.
CLV_READER_FN ClvHit clvHitOnSurface(CLV_READER uint primitive, float distance, vec3 rayDirection) {
    ClvHit hit = clvNoHit();
    if (primitive == kClvNoPrimitive) return hit;
    vec4 normal = CLV_READ clvReadSurface(primitive * kClvSurfaceRows);
    vec4 albedo = CLV_READ clvReadSurface(primitive * kClvSurfaceRows + 1u);
    hit.normal = clvFacingNormal(vec3(normal.x, normal.y, normal.z), rayDirection);
    hit.distance = distance;
    hit.albedo = vec3(albedo.x, albedo.y, albedo.z);
    hit.primitive = primitive;
    return hit;
}

CLV_NAMESPACE_END
#endif
