// Rays from texels that are drawn in proportion to their flux, cosine-distributed.
#include "rays.hlsli"

float direct(ClvRsmTexel texel, float2 u, uint index, out float3 direction) {
    direction = clvCosineFromSquare(u, texel.normal);
    return 1.0;
}
