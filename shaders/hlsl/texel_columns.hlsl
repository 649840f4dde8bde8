// The running sums over all rows of texels, by one work group, in place of the rows' flux.
#include "clv/data/frame.h"

[[vk::binding(CLV_BIND_FRAME)]] cbuffer FrameBlock { ClvFrame frame; };
[[vk::binding(CLV_BIND_TEXEL_SUMS)]] RWStructuredBuffer<float> texelSums;

uint overRows() { return frame.texelRows * (frame.rsmSide + 1); }
float readWeight(uint i) { return texelSums[overRows() + i + 1]; }
void writeSum(uint i, float sum) { texelSums[overRows() + i] = sum; }
#include "running_sums.hlsli"

[numthreads(CLV_GROUP_SIZE, 1, 1)]
void main(uint thread : SV_GroupIndex) { writeRunningSums(thread, frame.texelRows); }
