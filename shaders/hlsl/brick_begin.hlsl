// Gives each brick's list its place: lists lie one after another, in the order in which work groups come.
#include "clv/data/frame.h"

[[vk::binding(CLV_BIND_FRAME)]] cbuffer FrameBlock { ClvFrame frame; };
[[vk::binding(CLV_BIND_LEVEL)]] cbuffer LevelBlock { ClvLevelFrame level; };
[[vk::binding(CLV_BIND_BRICK_CURSORS)]] RWStructuredBuffer<uint> cursors;
[[vk::binding(CLV_BIND_BRICK_BEGINS)]] RWStructuredBuffer<uint> begins;

groupshared uint groupTotal;
groupshared uint groupBegin;

[numthreads(CLV_GROUP_SIZE, 1, 1)]
void main(uint3 thread : SV_DispatchThreadID, uint inGroup : SV_GroupIndex) {
    uint i = clvItem(thread);
    uint lists = frame.halves * level.brickCount;
    if (inGroup == 0u) groupTotal = 0u;
    GroupMemoryBarrierWithGroupSync();
    uint count = 0u;
    if (i < lists) count = cursors[i];
    uint before;
    InterlockedAdd(groupTotal, count, before);
    GroupMemoryBarrierWithGroupSync();
    if (inGroup == 0u) InterlockedAdd(cursors[lists], groupTotal, groupBegin);
    GroupMemoryBarrierWithGroupSync();
    if (i >= lists) return;
    begins[i] = groupBegin + before;
    cursors[i] = groupBegin + before;
}
