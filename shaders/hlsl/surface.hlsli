// What a ray finds on a triangle in a scene without textures.
[[vk::binding(CLV_BIND_SURFACES)]] Buffer<float4> surfaces;
float4 clvReadSurface(uint row) { return surfaces.Load(int(row)); }
#include "clv/stages/surface.h"

ClvHit surfaceHit(ClvBvhHit met, float3 direction) { return clvHitOnSurface(met.primitive, met.distance, direction); }
