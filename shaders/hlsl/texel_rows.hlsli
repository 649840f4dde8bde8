// Body of texel_rows and texel_rows_guided: the running sums of one row of texels, a work group a row. Leaves the row's sum where the
// sums over all rows will lie. The entry point defines texelWeight.
#include "clv/data/frame.h"
#include "clv/stages/rays.h"
[[vk::binding(CLV_BIND_FRAME)]] cbuffer FrameBlock { ClvFrame frame; };
[[vk::binding(CLV_BIND_TEXELS)]] StructuredBuffer<ClvRsmTexel> texels;
[[vk::binding(CLV_BIND_TEXEL_SUMS)]] RWStructuredBuffer<float> texelSums;

// A texel's chance to be picked is in proportion to this.
float texelWeight(ClvRsmTexel texel);

static uint row;
float readWeight(uint i) { return texelWeight(texels[row * frame.rsmSide + i]); }
void writeSum(uint i, float sum) { texelSums[row * (frame.rsmSide + 1) + i] = sum; }
#include "running_sums.hlsli"

[numthreads(CLV_GROUP_SIZE, 1, 1)]
void main(uint3 item : SV_DispatchThreadID, uint thread : SV_GroupIndex) {
    row = clvItem(item) / CLV_GROUP_SIZE;
    if (row >= frame.texelRows) return;
    float sum = writeRunningSums(thread, frame.rsmSide);
    uint overRows = frame.texelRows * (frame.rsmSide + 1);
    if (thread == 0) texelSums[overRows + row + 1] = sum;
}
