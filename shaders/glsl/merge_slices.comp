// Moves the history of a slot towards what was drawn into its cell.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "clv/data/frame.h"
#include "clv/stages/merge.h"
#include "clv/stages/slices.h"
layout(constant_id = CLV_SPEC_CHANNELS) const uint channels = 3u;
layout(constant_id = CLV_SPEC_STRIDE) const uint stride = 32u;
layout(local_size_x = CLV_GROUP_SIZE) in;
layout(std140, binding = CLV_BIND_FRAME) uniform FrameBlock { ClvFrame frame; };
layout(std140, binding = CLV_BIND_LEVEL) uniform LevelBlock { ClvLevelFrame level; };
layout(std430, binding = CLV_BIND_SLOTS) readonly buffer Slots { ClvSlot slots[]; };
layout(binding = CLV_BIND_SIDE_0) uniform texture3D side0;
layout(binding = CLV_BIND_SIDE_1) uniform texture3D side1;
layout(binding = CLV_BIND_SIDE_2) uniform texture3D side2;
layout(binding = CLV_BIND_SIDE_3) uniform texture3D side3;
layout(binding = CLV_BIND_SIDE_4) uniform texture3D side4;
layout(binding = CLV_BIND_SIDE_5) uniform texture3D side5;
layout(std430, binding = CLV_BIND_HISTORY) buffer History { vec4 history[]; };

void main() {
    uint i = clvItem(gl_GlobalInvocationID);
    if (i >= frame.halves * level.slotCount) return;
    ivec3 at = clvCellFromIndex(level.volume, slots[i % level.slotCount].cell);
    at += ivec3(kClvSliceRim, kClvSliceRim, i / level.slotCount * uint(level.volume.resolution.z));
    ClvRecord sum = clvRecordOfSides(texelFetch(side0, at, 0), texelFetch(side1, at, 0), texelFetch(side2, at, 0),
                                     texelFetch(side3, at, 0), texelFetch(side4, at, 0), texelFetch(side5, at, 0));
    for (uint row = 0u; row < stride / 4u; ++row) {
        uint k = i * (stride / 4u) + row;
        history[k] = clvMergeStep(history[k], clvRecordRow(sum, channels, row) * level.scale, level.weight);
    }
}
