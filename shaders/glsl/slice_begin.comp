// No lines in any slice.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "clv/data/frame.h"

layout(local_size_x = CLV_GROUP_SIZE) in;
layout(std140, binding = CLV_BIND_FRAME) uniform FrameBlock { ClvFrame frame; };
layout(std140, binding = CLV_BIND_LEVEL) uniform LevelBlock { ClvLevelFrame level; };
layout(std430, binding = CLV_BIND_SLICE_DRAWS) writeonly buffer Draws { uvec4 draws[]; };

void main() {
    uint i = clvItem(gl_GlobalInvocationID);
    if (i < frame.halves * uint(level.volume.resolution.z)) draws[i] = uvec4(0u, 1u, 0u, 0u);
}
