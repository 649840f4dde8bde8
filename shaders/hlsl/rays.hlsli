// Body of rays and rays_guided: a ray from a texel that is drawn by the running sums. The entry point defines direct.
#include "clv/data/frame.h"
#include "clv/math/sobol.h"
#include "clv/stages/rays.h"
[[vk::binding(CLV_BIND_FRAME)]] cbuffer FrameBlock { ClvFrame frame; };
[[vk::binding(CLV_BIND_TEXELS)]] StructuredBuffer<ClvRsmTexel> texels;
[[vk::binding(CLV_BIND_TEXEL_SUMS)]] StructuredBuffer<float> texelSums;
[[vk::binding(CLV_BIND_RAYS)]] RWStructuredBuffer<ClvRay> rays;

float clvReadTexelSum(uint i) { return texelSums[i]; }
#include "clv/stages/pick_texel.h"

// The direction of ray `index`; returns by how much it is preferred to a cosine-distributed one. u: in [0, 1)^2.
float direct(ClvRsmTexel texel, float2 u, uint index, out float3 direction);

[numthreads(CLV_GROUP_SIZE, 1, 1)]
void main(uint3 thread : SV_DispatchThreadID) {
    uint i = clvItem(thread);
    if (i >= frame.rayCount) return;
    uint perHalf = frame.rayCount / frame.halves;
    uint index = frame.firstIndex + i / perHalf * frame.halfStep + clvNeighbourIndex(i % perHalf, perHalf);
    float4 u = clvSobol4(index, frame.seed);
    ClvTexelPick pick = clvPickTexel(frame.rsmSide, frame.texelRows, float2(u.x, u.y));
    ClvRay ray = clvDeadRay();
    if (pick.probability > 0.0) {
        ClvRsmTexel texel = texels[pick.texel];
        float3 direction;
        float probability = pick.probability * direct(texel, float2(u.z, u.w), index, direction);
        ray = clvRayAlong(texel, direction, 1.0 / probability, frame.originOffset);
    }
    rays[i] = ray;
}
