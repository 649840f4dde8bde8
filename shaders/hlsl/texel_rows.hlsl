// The running sums of one row of texels; a work group a row. Leaves the row's flux where the sums over all rows will lie.
#include "clv/data/frame.h"
#include "clv/data/rsm_texel.h"

[[vk::binding(CLV_BIND_FRAME)]] cbuffer FrameBlock { ClvFrame frame; };
[[vk::binding(CLV_BIND_TEXELS)]] StructuredBuffer<ClvRsmTexel> texels;
[[vk::binding(CLV_BIND_TEXEL_SUMS)]] RWStructuredBuffer<float> texelSums;

static uint row;
float clvReadTexelSum(uint i) { return texelSums[i]; }
#include "clv/stages/pick_texel.h"
float readWeight(uint i) { return clvTexelWeight(texels[row * frame.rsmSide + i]); }
void writeSum(uint i, float sum) { texelSums[row * (frame.rsmSide + 1) + i] = sum; }
#include "running_sums.hlsli"

[numthreads(CLV_GROUP_SIZE, 1, 1)]
void main(uint3 item : SV_DispatchThreadID, uint thread : SV_GroupIndex) {
    row = clvItem(item) / CLV_GROUP_SIZE;
    if (row >= frame.texelRows) return;
    float flux = writeRunningSums(thread, frame.rsmSide);
    uint overRows = frame.texelRows * (frame.rsmSide + 1);
    if (thread == 0) texelSums[overRows + row + 1] = flux;
}
