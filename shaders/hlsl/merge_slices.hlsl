// Moves the history of a slot towards what was drawn into its cell.
#include "clv/data/frame.h"
#include "clv/stages/merge.h"
#include "clv/stages/slices.h"
[[vk::constant_id(CLV_SPEC_CHANNELS)]] const uint channels = 3u;
[[vk::constant_id(CLV_SPEC_STRIDE)]] const uint stride = 32u;
[[vk::binding(CLV_BIND_FRAME)]] cbuffer FrameBlock { ClvFrame frame; };
[[vk::binding(CLV_BIND_LEVEL)]] cbuffer LevelBlock { ClvLevelFrame level; };
[[vk::binding(CLV_BIND_SLOTS)]] StructuredBuffer<ClvSlot> slots;
[[vk::binding(CLV_BIND_SIDE_0)]] Texture3D<float4> side0;
[[vk::binding(CLV_BIND_SIDE_1)]] Texture3D<float4> side1;
[[vk::binding(CLV_BIND_SIDE_2)]] Texture3D<float4> side2;
[[vk::binding(CLV_BIND_SIDE_3)]] Texture3D<float4> side3;
[[vk::binding(CLV_BIND_SIDE_4)]] Texture3D<float4> side4;
[[vk::binding(CLV_BIND_SIDE_5)]] Texture3D<float4> side5;
[[vk::binding(CLV_BIND_HISTORY)]] RWStructuredBuffer<float4> history;

[numthreads(CLV_GROUP_SIZE, 1, 1)]
void main(uint3 thread : SV_DispatchThreadID) {
    uint i = clvItem(thread);
    if (i >= frame.halves * level.slotCount) return;
    int3 at = clvCellFromIndex(level.volume, slots[i % level.slotCount].cell);
    at += int3(kClvSliceRim, kClvSliceRim, i / level.slotCount * uint(level.volume.resolution.z));
    int4 place = int4(at, 0);
    ClvRecord sum = clvRecordOfSides(side0.Load(place), side1.Load(place), side2.Load(place), side3.Load(place), side4.Load(place), side5.Load(place));
    for (uint row = 0u; row < stride / 4u; ++row) {
        uint k = i * (stride / 4u) + row;
        history[k] = clvMergeStep(history[k], clvRecordRow(sum, channels, row) * level.scale, level.weight);
    }
}
