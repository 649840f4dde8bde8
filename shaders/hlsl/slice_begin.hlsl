// No lines in any slice.
#include "clv/data/frame.h"

[[vk::binding(CLV_BIND_FRAME)]] cbuffer FrameBlock { ClvFrame frame; };
[[vk::binding(CLV_BIND_LEVEL)]] cbuffer LevelBlock { ClvLevelFrame level; };
[[vk::binding(CLV_BIND_SLICE_DRAWS)]] RWStructuredBuffer<uint4> draws;

[numthreads(CLV_GROUP_SIZE, 1, 1)]
void main(uint3 thread : SV_DispatchThreadID) {
    uint i = clvItem(thread);
    if (i < frame.halves * uint(level.volume.resolution.z)) draws[i] = uint4(0u, 1u, 0u, 0u);
}
