// Body of inject_bricks and inject_bricks_plain: eight lanes, a slot each, gather the rays of their brick and merge them into the
// history. The entry point defines ownSegment and segmentOfRay.
#extension GL_EXT_control_flow_attributes : require
#include "clv/data/frame.h"
#include "clv/stages/merge.h"
layout(constant_id = CLV_SPEC_STORAGE) const uint storage = 0u;
layout(constant_id = CLV_SPEC_CHANNELS) const uint channels = 3u;
layout(constant_id = CLV_SPEC_STRIDE) const uint stride = 32u;
layout(constant_id = CLV_SPEC_TURNED) const uint turned = 0u;
layout(constant_id = CLV_SPEC_DEPTH) const uint depth = 0u;
layout(local_size_x = CLV_GROUP_SIZE) in;
layout(std140, binding = CLV_BIND_FRAME) uniform FrameBlock { ClvFrame frame; };
layout(std140, binding = CLV_BIND_LEVEL) uniform LevelBlock { ClvLevelFrame level; };
layout(binding = CLV_BIND_RAYS) uniform samplerBuffer rays;
layout(std430, binding = CLV_BIND_TABLE) readonly buffer Table { uint table[]; };
layout(std430, binding = CLV_BIND_SPLITS) readonly buffer Splits { ClvSplit splits[]; };
layout(std430, binding = CLV_BIND_SLOTS) readonly buffer Slots { ClvSlot slots[]; };
layout(std430, binding = CLV_BIND_HISTORY) buffer History { vec4 history[]; };
layout(std430, binding = CLV_BIND_BRICK_CURSORS) readonly buffer Cursors { uint cursors[]; };
layout(std430, binding = CLV_BIND_BRICK_BEGINS) readonly buffer Begins { uint begins[]; };
layout(std430, binding = CLV_BIND_BRICK_RAYS) readonly buffer BrickRays { uint brickRays[]; };
layout(std430, binding = CLV_BIND_BRICK_SLOTS) readonly buffer BrickSlots { uint brickSlots[]; };

ClvSplit clvReadSplit(uint i) { return splits[i]; }
#include "clv/stages/gather.h"

// Entry i of the list that ends before `end`.
ClvSegment loadSegment(uint i, uint end) {
    if (i >= end) return clvNoSegment();
    int row = int(3u * brickRays[i]);
    ClvRay ray = clvRayFromRows(texelFetch(rays, row), texelFetch(rays, row + 1), texelFetch(rays, row + 2));
    return clvSegmentFromRay(level.volume, channels, ray, clvKeptDirection(frame, turned, ray.direction));
}

// What lane `lane` of the eight loads of the entries from `first` on.
ClvSegment ownSegment(uint first, uint lane, uint end);
// Entry first + k, for a lane that has loaded `own`.
ClvSegment segmentOfRay(uint first, uint k, uint end, uint lane, ClvSegment own);

void main() {
    ClvGatherPlace place = clvGatherPlace(level, depth, clvItem(gl_GlobalInvocationID));
    if (place.halfIndex >= frame.halves) return;  // the eight lanes of a group leave together
    uint lane = place.member % kClvBrickLanes;
    uint slot = brickSlots[place.member];
    uint firstSlot = brickSlots[place.member - lane];
    uint cell = slots[slot == kClvNoSlot ? firstSlot : slot].cell;
    ivec3 at = clvCellFromIndex(level.volume, cell);
    ClvGatherSlot mine = clvGatherSlot(slot, at, depth > 0u ? table[cell] : slot, depth);
    uint list = place.halfIndex * level.brickCount + clvBrickOfCell(level.volume, at);
    uint end = cursors[list];
    ClvRecord sum = clvNoRecord();
    // By eights: some drivers end an invocation's loops without a word after 65535 rounds.
    for (uint first = begins[list]; first < end; first += kClvBrickLanes) {
        ClvSegment own = ownSegment(first, lane, end);
        [[unroll]] for (uint k = 0u; k < kClvBrickLanes; ++k) {
            ClvSegment segment = segmentOfRay(first, k, end, lane, own);
            float weight = clvGatherWeight(mine, depth, segment, level.volume.cellSize);
            clvAddToRecord(sum, channels, clvDepositCoefficients(storage, segment.kept), segment.flux, weight);
        }
    }
    if (slot == kClvNoSlot) return;
    uint firstRow = (place.halfIndex * level.slotCount + slot) * (stride / 4u);
    [[unroll]] for (uint row = 0u; row < stride / 4u; ++row) {
        history[firstRow + row] = clvMergeStep(history[firstRow + row], clvRecordRow(sum, channels, row) * level.scale, level.weight);
    }
}
