// What a ray meets in a scene without textures.
#include "bvh.hlsli"

[[vk::binding(CLV_BIND_SURFACES)]] Buffer<float4> surfaces;
float4 clvReadSurface(uint row) { return surfaces.Load(int(row)); }
#include "clv/stages/surface.h"

ClvHit sceneHit(ClvRay ray) {
    ClvBvhHit met = clvTraceBvh(ray.origin, ray.direction, ray.maxDistance);
    return clvHitOnSurface(met.primitive, met.distance, ray.direction);
}
