// Slots gather the rays of their brick: each of the eight lanes loads one ray, and shuffles share it. Subgroups have a multiple of eight
// lanes.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "inject_bricks.glsl"

ClvSegment ownSegment(uint first, uint lane, uint end) { return loadSegment(first + lane, end); }

ClvSegment segmentOfRay(uint first, uint k, uint end, uint lane, ClvSegment own) {
    uint from = gl_SubgroupInvocationID - lane + k;
    ClvSegment segment;
    segment.origin = subgroupShuffle(own.origin, from);
    segment.tEnd = subgroupShuffle(own.tEnd, from);
    segment.inverse = subgroupShuffle(own.inverse, from);
    segment.start = subgroupShuffle(own.start, from);
    segment.direction = subgroupShuffle(own.direction, from);
    segment.kept = segment.direction;
    if (turned != 0u) segment.kept = subgroupShuffle(own.kept, from);
    segment.flux = subgroupShuffle(own.flux, from);
    return segment;
}
