// Slots gather the rays of their brick: each lane loads every ray, so that no subgroups are needed.
#include "inject_bricks.hlsli"

ClvSegment ownSegment(uint first, uint lane, uint end) { return clvNoSegment(); }
ClvSegment segmentOfRay(uint first, uint k, uint end, uint lane, ClvSegment own) { return loadSegment(first + k, end); }
