// A ray from a texel that is drawn in proportion to its flux.
#include "clv/data/frame.h"
#include "clv/data/gpu_bindings.h"
#include "clv/math/sobol.h"
#include "clv/stages/rays.h"

[[vk::binding(CLV_BIND_FRAME)]] cbuffer FrameBlock { ClvFrame frame; };
[[vk::binding(CLV_BIND_TEXELS)]] StructuredBuffer<ClvRsmTexel> texels;
[[vk::binding(CLV_BIND_TEXEL_SUMS)]] StructuredBuffer<float> texelSums;
[[vk::binding(CLV_BIND_RAYS)]] RWStructuredBuffer<ClvRay> rays;

float clvReadTexelSum(uint i) { return texelSums[i]; }
#include "clv/stages/pick_texel.h"

[numthreads(CLV_GROUP_SIZE, 1, 1)]
void main(uint3 thread : SV_DispatchThreadID) {
    uint i = clvItem(thread);
    if (i >= frame.rayCount) return;
    uint perHalf = frame.rayCount / frame.halves;
    float4 u = clvSobol4(frame.firstIndex + i / perHalf * perHalf + clvNeighbourIndex(i % perHalf, perHalf), frame.seed);
    ClvTexelPick pick = clvPickTexel(frame.rsmSide, frame.texelRows, float2(u.x, u.y));
    ClvRay ray = clvDeadRay();
    if (pick.probability > 0.0) ray = clvRayFromTexel(texels[pick.texel], float2(u.z, u.w), 1.0 / pick.probability, frame.originOffset);
    rays[i] = ray;
}
