// What a ray finds on a triangle in a scene with textures.
layout(binding = CLV_BIND_SURFACES) uniform samplerBuffer surfaces;
layout(binding = CLV_BIND_TEXTURE_ROWS) uniform usamplerBuffer textureRows;
layout(binding = CLV_BIND_TEXTURE_TEXELS) uniform samplerBuffer textureTexels;
vec4 clvReadSurface(uint row) { return texelFetch(surfaces, int(row)); }
uvec4 clvReadTextureRow(uint row) { return texelFetch(textureRows, int(row)); }
vec4 clvReadTextureTexel(uint index) { return texelFetch(textureTexels, int(index)); }
#include "clv/stages/surface.h"
#include "clv/stages/texture.h"

ClvHit surfaceHit(ClvBvhHit met, vec3 direction) {
    ClvHit hit = clvHitOnSurface(met.primitive, met.distance, direction);
    if (met.primitive != kClvNoPrimitive) hit.albedo *= clvTextureOn(met.primitive, met.u, met.v);
    return hit;
}
