// What a ray finds on a triangle in a scene without textures.
layout(binding = CLV_BIND_SURFACES) uniform samplerBuffer surfaces;
vec4 clvReadSurface(uint row) { return texelFetch(surfaces, int(row)); }
#include "clv/stages/surface.h"

ClvHit surfaceHit(ClvBvhHit met, vec3 direction) { return clvHitOnSurface(met.primitive, met.distance, direction); }
