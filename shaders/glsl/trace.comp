// Cuts a ray at the first triangle that it meets.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "clv/data/frame.h"
#include "clv/data/ray.h"

layout(local_size_x = CLV_GROUP_SIZE) in;
layout(std140, binding = CLV_BIND_FRAME) uniform FrameBlock { ClvFrame frame; };
layout(std430, binding = CLV_BIND_RAYS) buffer Rays { ClvRay rays[]; };
#include "bvh.glsl"

void main() {
    uint i = clvItem(gl_GlobalInvocationID);
    if (i >= frame.rayCount) return;
    rays[i].maxDistance = clvTraceBvh(rays[i].origin, rays[i].direction, rays[i].maxDistance).distance;
}
