// What a ray finds on a triangle in a scene with textures.
[[vk::binding(CLV_BIND_SURFACES)]] Buffer<float4> surfaces;
[[vk::binding(CLV_BIND_TEXTURE_ROWS)]] Buffer<uint4> textureRows;
[[vk::binding(CLV_BIND_TEXTURE_TEXELS)]] Buffer<float4> textureTexels;
float4 clvReadSurface(uint row) { return surfaces.Load(int(row)); }
uint4 clvReadTextureRow(uint row) { return textureRows.Load(int(row)); }
float4 clvReadTextureTexel(uint index) { return textureTexels.Load(int(index)); }
#include "clv/stages/surface.h"
#include "clv/stages/texture.h"

ClvHit surfaceHit(ClvBvhHit met, float3 direction) {
    ClvHit hit = clvHitOnSurface(met.primitive, met.distance, direction);
    if (met.primitive != kClvNoPrimitive) hit.albedo *= clvTextureOn(met.primitive, met.u, met.v);
    return hit;
}
