// What the walk of each ray adds up to: for tests of a device.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "clv/data/frame.h"
#include "clv/stages/walk_check.h"

layout(local_size_x = CLV_GROUP_SIZE) in;
layout(std140, binding = CLV_BIND_FRAME) uniform FrameBlock { ClvFrame frame; };
layout(std140, binding = CLV_BIND_LEVEL) uniform LevelBlock { ClvLevelFrame level; };
layout(binding = CLV_BIND_RAYS) uniform samplerBuffer rays;
layout(std430, binding = CLV_BIND_WALK_CHECKS) writeonly buffer Checks { ClvWalkCheck checks[]; };

void main() {
    uint i = clvItem(gl_GlobalInvocationID);
    if (i >= frame.rayCount) return;
    int row = int(3u * i);
    ClvRay ray = clvRayFromRows(texelFetch(rays, row), texelFetch(rays, row + 1), texelFetch(rays, row + 2));
    checks[i] = clvCheckWalk(level.volume, ray);
}
