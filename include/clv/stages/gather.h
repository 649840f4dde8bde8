// Inject the other way round: a slot gathers the pieces of the rays that cross its brick, and is written once, without atomics.
//
// A shader defines, before it includes this: ClvSplit clvReadSplit(uint index).
//
// A brick is 2^3 cells. First each ray is listed in the bricks that it crosses, then eight lanes, a slot each, go through the list of
// their brick. A piece is computed as the walk of stages/inject.h computes it, so that both deposit the same lengths. For the
// track-length estimator alone: the thesis' rule also counts cells that a ray merely touches.
#ifndef CLV_STAGES_GATHER_H
#define CLV_STAGES_GATHER_H
#include "../data/frame.h"
#include "bricks.h"
#include "find_slot.h"
#include "inject.h"
#include "record.h"
CLV_NAMESPACE_BEGIN

// A ray made ready to be clipped against many cells.
struct ClvSegment {
    vec3 origin;     // in cells, from the volume's lowest corner
    float tEnd;      // where the ray ends or leaves the grid, in cells; negative: it crosses nothing
    vec3 inverse;    // 1 / direction
    vec3 start;      // m, the origin again
    vec3 direction;
    vec3 kept;       // the direction as cells keep it
    vec3 flux;       // W, by channel: see clvChannelFlux
};

CLV_FN ClvSegment clvNoSegment() {
    ClvSegment segment;
    segment.origin = vec3(0.0f, 0.0f, 0.0f);
    segment.tEnd = -1.0f;
    segment.inverse = vec3(1.0f, 1.0f, 1.0f);
    segment.start = vec3(0.0f, 0.0f, 0.0f);
    segment.direction = vec3(0.0f, 0.0f, 0.0f);
    segment.kept = vec3(0.0f, 0.0f, 0.0f);
    segment.flux = vec3(0.0f, 0.0f, 0.0f);
    return segment;
}

// An axis that the ray runs parallel to: the faces of its own cell are endlessly far in both directions, those of others in one.
CLV_FN void clvSegmentAlongAxis(float direction, int cell, CLV_INOUT(float) origin, CLV_INOUT(float) inverse) {
    if (abs(direction) > kClvParallel) return;
    inverse = kClvNever;
    // The walk counts the grid's upper face to the last cell.
    if (origin >= float(cell + 1)) origin = float(cell) + 0.5f;
}

CLV_FN ClvSegment clvSegmentFromRay(ClvVolume volume, uint channels, ClvRay ray, vec3 kept) {
    ClvWalk walk = clvWalkBegin(volume, ray);
    if (walk.running == 0 || !clvCarriesLight(ray)) return clvNoSegment();
    ClvSegment segment;
    segment.origin = walk.origin;
    segment.tEnd = walk.tEnd;
    segment.inverse = walk.inverse;
    segment.start = ray.origin;
    segment.direction = ray.direction;
    segment.kept = kept;
    segment.flux = clvChannelFlux(channels, ray, clvMostFlux(kClvInjectTrackLength, volume.cellSize));
    clvSegmentAlongAxis(ray.direction.x, walk.cell.x, segment.origin.x, segment.inverse.x);
    clvSegmentAlongAxis(ray.direction.y, walk.cell.y, segment.origin.y, segment.inverse.y);
    clvSegmentAlongAxis(ray.direction.z, walk.cell.z, segment.origin.z, segment.inverse.z);
    return segment;
}

// Where the segment enters and leaves the cell with this lowest corner, in cells along it; it leaves no later than it enters where
// it does not cross the cell.
CLV_FN vec2 clvSegmentPiece(ClvSegment segment, vec3 corner) {
    vec3 a = (corner - segment.origin) * segment.inverse;
    vec3 b = (corner + vec3(1.0f, 1.0f, 1.0f) - segment.origin) * segment.inverse;
    vec3 enter = min(a, b);
    vec3 leave = max(a, b);
    return vec2(max(max(enter.x, enter.y), max(enter.z, 0.0f)), min(min(leave.x, leave.y), min(leave.z, segment.tEnd)));
}

// What a lane fills: slot number `member` of the brick slots, in this half's deposits.
struct ClvGatherPlace {
    uint halfIndex;
    uint member;
};

// The place of lane `item` among the groups whose cells have `depth` splits; halfIndex >= frame.halves: there is none.
CLV_FN ClvGatherPlace clvGatherPlace(ClvLevelFrame level, uint depth, uint item) {
    uint first = depth == 0u ? 0u : depth == 1u ? level.groupEnds.x : depth == 2u ? level.groupEnds.y : depth == 3u ? level.groupEnds.z : level.groupEnds.w;
    uint end = depth == 0u ? level.groupEnds.x : depth == 1u ? level.groupEnds.y : depth == 2u ? level.groupEnds.z : depth == 3u ? level.groupEnds.w : level.groupCount;
    uint lanes = (end - first) * kClvBrickLanes;
    ClvGatherPlace place;
    place.halfIndex = item / lanes;
    place.member = first * kClvBrickLanes + item % lanes;
    return place;
}

// A lane's slot, and how the rest of its cell is told from it.
struct ClvGatherSlot {
    vec3 corner;     // of its cell, in cells
    uint slot;       // kClvNoSlot: the lane has none
    uint entry;      // of the cell in the table: the slot, or the cell's first split
    ClvSplit split;  // that one
};

// The slot in a cell with this table entry, which is read where depth > 0.
CLV_READER_FN ClvGatherSlot clvGatherSlot(CLV_READER uint slot, ivec3 cell, uint entry, uint depth) {
    ClvGatherSlot lane;
    lane.corner = vec3(float(cell.x), float(cell.y), float(cell.z));
    lane.slot = slot;
    lane.entry = entry;
    if (depth > 0u && clvIsSplit(entry)) lane.split = CLV_READ clvReadSplit(entry & ~kClvSplitBit);
    return lane;
}

// Whether the slot holds a position in its cell. depth: splits between its cell and a slot, at most; a constant, so that slots that are
// whole cells carry none of it.
CLV_READER_FN bool clvSlotHolds(CLV_READER ClvGatherSlot lane, uint depth, vec3 position) {
    if (depth == 0u) return true;
    uint entry = clvIsSplit(lane.entry) ? clvSideOfSplit(lane.split, position) : lane.entry;
    if (depth > 1u && clvIsSplit(entry)) entry = clvSideOfSplit(CLV_READ clvReadSplit(entry & ~kClvSplitBit), position);
    if (depth > 2u && clvIsSplit(entry)) entry = clvSideOfSplit(CLV_READ clvReadSplit(entry & ~kClvSplitBit), position);
    if (depth > 3u && clvIsSplit(entry)) entry = clvSideOfSplit(CLV_READ clvReadSplit(entry & ~kClvSplitBit), position);
    return entry == lane.slot;
}

// Length of the segment in the slot, m.
CLV_READER_FN float clvGatherWeight(CLV_READER ClvGatherSlot lane, uint depth, ClvSegment segment, float cellSize) {
    vec2 piece = clvSegmentPiece(segment, lane.corner);
    vec3 middle = segment.start + segment.direction * (0.5f * (piece.x + piece.y) * cellSize);
    return clvSlotHolds(CLV_PASS_READER lane, depth, middle) ? max(piece.y - piece.x, 0.0f) * cellSize : 0.0f;
}

CLV_NAMESPACE_END
#endif
