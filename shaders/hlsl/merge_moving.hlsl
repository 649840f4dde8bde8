// Moves the history of moving lights towards this frame's estimate, four numbers a thread, and clears the sums for the next frame.
#include "clv/data/frame.h"
#include "clv/stages/merge.h"
[[vk::constant_id(CLV_SPEC_STRIDE)]] const uint stride = 32u;
[[vk::binding(CLV_BIND_FRAME)]] cbuffer FrameBlock { ClvFrame frame; };
[[vk::binding(CLV_BIND_LEVEL)]] cbuffer LevelBlock { ClvLevelFrame level; };
[[vk::binding(CLV_BIND_DEPOSITS)]] RWStructuredBuffer<float4> deposits;
[[vk::binding(CLV_BIND_HISTORY)]] RWStructuredBuffer<float4> history;
[[vk::binding(CLV_BIND_SLOT_FRAMES)]] StructuredBuffer<float> slotFrames;

[numthreads(CLV_GROUP_SIZE, 1, 1)]
void main(uint3 thread : SV_DispatchThreadID) {
    uint i = clvItem(thread);
    if (i >= frame.halves * level.slotCount * (stride / 4u)) return;
    history[i] = clvMergeMean(history[i], deposits[i] * level.scale, 1.0 / slotFrames[i / (stride / 4u)]);
    deposits[i] = float4(0.0, 0.0, 0.0, 0.0);
}
