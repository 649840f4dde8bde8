// What a ray meets in a scene without textures.
#include "bvh.glsl"

layout(binding = CLV_BIND_SURFACES) uniform samplerBuffer surfaces;
vec4 clvReadSurface(uint row) { return texelFetch(surfaces, int(row)); }
#include "clv/stages/surface.h"

ClvHit sceneHit(ClvRay ray) {
    ClvBvhHit met = clvTraceBvh(ray.origin, ray.direction, ray.maxDistance);
    return clvHitOnSurface(met.primitive, met.distance, ray.direction);
}
