// Slots gather the rays of their brick: each of the eight lanes loads one ray, and shuffles share it. Subgroups have a multiple of eight
// lanes.
#include "inject_bricks.hlsli"

ClvSegment ownSegment(uint first, uint lane, uint end) { return loadSegment(first + lane, end); }

ClvSegment segmentOfRay(uint first, uint k, uint end, uint lane, ClvSegment own) {
    uint from = WaveGetLaneIndex() - lane + k;
    ClvSegment segment;
    segment.origin = WaveReadLaneAt(own.origin, from);
    segment.tEnd = WaveReadLaneAt(own.tEnd, from);
    segment.inverse = WaveReadLaneAt(own.inverse, from);
    segment.start = WaveReadLaneAt(own.start, from);
    segment.direction = WaveReadLaneAt(own.direction, from);
    segment.kept = segment.direction;
    if (turned != 0u) segment.kept = WaveReadLaneAt(own.kept, from);
    segment.flux = WaveReadLaneAt(own.flux, from);
    return segment;
}
