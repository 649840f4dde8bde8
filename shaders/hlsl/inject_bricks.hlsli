// Body of inject_bricks and inject_bricks_plain: eight lanes, a slot each, gather the rays of their brick and merge them into the
// history. The entry point defines ownSegment and segmentOfRay.
#include "clv/data/frame.h"
#include "clv/stages/merge.h"
[[vk::constant_id(CLV_SPEC_STORAGE)]] const uint storage = 0u;
[[vk::constant_id(CLV_SPEC_CHANNELS)]] const uint channels = 3u;
[[vk::constant_id(CLV_SPEC_STRIDE)]] const uint stride = 32u;
[[vk::constant_id(CLV_SPEC_TURNED)]] const uint turned = 0u;
[[vk::constant_id(CLV_SPEC_DEPTH)]] const uint depth = 0u;
[[vk::binding(CLV_BIND_FRAME)]] cbuffer FrameBlock { ClvFrame frame; };
[[vk::binding(CLV_BIND_LEVEL)]] cbuffer LevelBlock { ClvLevelFrame level; };
[[vk::binding(CLV_BIND_RAYS)]] Buffer<float4> rays;
[[vk::binding(CLV_BIND_TABLE)]] StructuredBuffer<uint> table;
[[vk::binding(CLV_BIND_SPLITS)]] StructuredBuffer<ClvSplit> splits;
[[vk::binding(CLV_BIND_SLOTS)]] StructuredBuffer<ClvSlot> slots;
[[vk::binding(CLV_BIND_HISTORY)]] RWStructuredBuffer<float4> history;
[[vk::binding(CLV_BIND_BRICK_CURSORS)]] StructuredBuffer<uint> cursors;
[[vk::binding(CLV_BIND_BRICK_BEGINS)]] StructuredBuffer<uint> begins;
[[vk::binding(CLV_BIND_BRICK_RAYS)]] StructuredBuffer<uint> brickRays;
[[vk::binding(CLV_BIND_BRICK_SLOTS)]] StructuredBuffer<uint> brickSlots;

ClvSplit clvReadSplit(uint i) { return splits[i]; }
#include "clv/stages/gather.h"

// Entry i of the list that ends before `end`.
ClvSegment loadSegment(uint i, uint end) {
    if (i >= end) return clvNoSegment();
    int row = int(3u * brickRays[i]);
    ClvRay ray = clvRayFromRows(rays.Load(row), rays.Load(row + 1), rays.Load(row + 2));
    return clvSegmentFromRay(level.volume, channels, ray, clvKeptDirection(frame, turned, ray.direction));
}

// What lane `lane` of the eight loads of the entries from `first` on.
ClvSegment ownSegment(uint first, uint lane, uint end);
// Entry first + k, for a lane that has loaded `own`.
ClvSegment segmentOfRay(uint first, uint k, uint end, uint lane, ClvSegment own);

[numthreads(CLV_GROUP_SIZE, 1, 1)]
void main(uint3 thread : SV_DispatchThreadID) {
    ClvGatherPlace place = clvGatherPlace(level, depth, clvItem(thread));
    if (place.halfIndex >= frame.halves) return;  // the eight lanes of a group leave together
    uint lane = place.member % kClvBrickLanes;
    uint slot = brickSlots[place.member];
    uint firstSlot = brickSlots[place.member - lane];
    uint cell = slots[slot == kClvNoSlot ? firstSlot : slot].cell;
    int3 at = clvCellFromIndex(level.volume, cell);
    ClvGatherSlot mine = clvGatherSlot(slot, at, depth > 0u ? table[cell] : slot, depth);
    uint list = place.halfIndex * level.brickCount + clvBrickOfCell(level.volume, at);
    uint end = cursors[list];
    ClvRecord sum = clvNoRecord();
    // By eights: some drivers end an invocation's loops without a word after 65535 rounds.
    for (uint first = begins[list]; first < end; first += kClvBrickLanes) {
        ClvSegment own = ownSegment(first, lane, end);
        [unroll] for (uint k = 0u; k < kClvBrickLanes; ++k) {
            ClvSegment segment = segmentOfRay(first, k, end, lane, own);
            float weight = clvGatherWeight(mine, depth, segment, level.volume.cellSize);
            clvAddToRecord(sum, channels, clvDepositCoefficients(storage, segment.kept), segment.flux, weight);
        }
    }
    if (slot == kClvNoSlot) return;
    uint firstRow = (place.halfIndex * level.slotCount + slot) * (stride / 4u);
    [unroll] for (uint row = 0u; row < stride / 4u; ++row) {
        history[firstRow + row] = clvMergeStep(history[firstRow + row], clvRecordRow(sum, channels, row) * level.scale, level.weight);
    }
}
