// Moves the history of moving lights towards this frame's estimate, four numbers a thread, and clears the sums for the next frame.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "clv/data/frame.h"
#include "clv/stages/merge.h"
layout(constant_id = CLV_SPEC_STRIDE) const uint stride = 32u;
layout(local_size_x = CLV_GROUP_SIZE) in;
layout(std140, binding = CLV_BIND_FRAME) uniform FrameBlock { ClvFrame frame; };
layout(std140, binding = CLV_BIND_LEVEL) uniform LevelBlock { ClvLevelFrame level; };
layout(std430, binding = CLV_BIND_DEPOSITS) buffer Deposits { vec4 deposits[]; };
layout(std430, binding = CLV_BIND_HISTORY) buffer History { vec4 history[]; };
layout(std430, binding = CLV_BIND_SLOT_FRAMES) readonly buffer SlotFrames { float slotFrames[]; };

void main() {
    uint i = clvItem(gl_GlobalInvocationID);
    if (i >= frame.halves * level.slotCount * (stride / 4u)) return;
    history[i] = clvMergeMean(history[i], deposits[i] * level.scale, 1.0 / slotFrames[i / (stride / 4u)]);
    deposits[i] = vec4(0.0);
}
