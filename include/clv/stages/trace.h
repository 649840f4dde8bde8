// The trace stage is a contract, since every engine has its own way to intersect rays:
//
// In: rays with maxDistance = kClvFar, or 0 for a dead one. Out: the same rays in the same order, each cut at the nearest
// surface that it meets, and for each the hit: its distance, the surface's normal turned against the ray and its albedo.
// - Every surface blocks light from both sides, whatever its material says.
// - Surfaces at distance 0 do not count; rays start far enough off their own surface (originOffset of the rays stage).
// - A ray that meets nothing keeps maxDistance = kClvFar, and its hit has normal 0 and distance kClvFar.
// - Dead rays need not be traced and stay as they are.
// - The geometry may be simpler than what is seen; position, direction and flux of a ray never change.
#ifndef CLV_STAGES_TRACE_H
#define CLV_STAGES_TRACE_H
#include "../data/hit.h"
#include "../data/ray.h"
CLV_NAMESPACE_BEGIN

// What a ray that met nothing has for a hit.
CLV_FN ClvHit clvNoHit() {
    ClvHit hit;
    hit.normal = vec3(0.0f, 0.0f, 0.0f);
    hit.distance = kClvFar;
    hit.albedo = vec3(0.0f, 0.0f, 0.0f);
    hit.primitive = kClvNoPrimitive;
    return hit;
}

// The ray, ended at the hit where that is nearer than its end so far. A NaN distance changes nothing.
CLV_FN ClvRay clvCutRay(ClvRay ray, ClvHit hit) {
    if (hit.distance < ray.maxDistance) ray.maxDistance = max(hit.distance, 0.0f);
    return ray;
}

// The normal (unit length, either way round) on the side that the ray comes from.
CLV_FN vec3 clvFacingNormal(vec3 normal, vec3 rayDirection) {
    return dot(normal, rayDirection) > 0.0f ? vec3(-normal.x, -normal.y, -normal.z) : normal;
}

CLV_NAMESPACE_END
#endif
