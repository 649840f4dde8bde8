// Takes this frame's dynamicity into that of the history, and says how many frames a slot's history stands for with this one.
#include "clv/data/frame.h"
#include "clv/stages/merge.h"
[[vk::binding(CLV_BIND_FRAME)]] cbuffer FrameBlock { ClvFrame frame; };
[[vk::binding(CLV_BIND_LEVEL)]] cbuffer LevelBlock { ClvLevelFrame level; };
[[vk::binding(CLV_BIND_MERGE)]] cbuffer MergeBlock { ClvMergeSettings settings; };
[[vk::binding(CLV_BIND_DYNAMICITY)]] RWStructuredBuffer<uint> dynamicity;
[[vk::binding(CLV_BIND_KEPT_DYNAMICITY)]] RWStructuredBuffer<float> keptDynamicity;
[[vk::binding(CLV_BIND_SLOT_FRAMES)]] RWStructuredBuffer<float> slotFrames;

[numthreads(CLV_GROUP_SIZE, 1, 1)]
void main(uint3 thread : SV_DispatchThreadID) {
    uint i = clvItem(thread);
    if (i >= frame.halves * level.slotCount) return;
    float largest = 0.0;
    for (uint k = 6u * i; k < 6u * i + 6u; ++k) {
        keptDynamicity[k] = clvMergeDynamicity(settings, keptDynamicity[k], clvFloatFromBits(dynamicity[k]));
        dynamicity[k] = 0u;
        largest = max(largest, keptDynamicity[k]);
    }
    slotFrames[i] = clvFramesFromWeight(clvMergeWeight(settings, largest, slotFrames[i] + 1.0));
}
