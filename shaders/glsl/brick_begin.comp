// Gives each brick's list its place: lists lie one after another, in the order in which work groups come.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "clv/data/frame.h"

layout(local_size_x = CLV_GROUP_SIZE) in;
layout(std140, binding = CLV_BIND_FRAME) uniform FrameBlock { ClvFrame frame; };
layout(std140, binding = CLV_BIND_LEVEL) uniform LevelBlock { ClvLevelFrame level; };
layout(std430, binding = CLV_BIND_BRICK_CURSORS) buffer Cursors { uint cursors[]; };
layout(std430, binding = CLV_BIND_BRICK_BEGINS) writeonly buffer Begins { uint begins[]; };

shared uint groupTotal;
shared uint groupBegin;

void main() {
    uint i = clvItem(gl_GlobalInvocationID);
    uint lists = frame.halves * level.brickCount;
    if (gl_LocalInvocationIndex == 0u) groupTotal = 0u;
    barrier();
    uint before = atomicAdd(groupTotal, i < lists ? cursors[i] : 0u);
    barrier();
    if (gl_LocalInvocationIndex == 0u) groupBegin = atomicAdd(cursors[lists], groupTotal);
    barrier();
    if (i >= lists) return;
    begins[i] = groupBegin + before;
    cursors[i] = groupBegin + before;
}
