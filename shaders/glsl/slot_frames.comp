// Takes this frame's dynamicity into that of the history, and says how many frames a slot's history stands for with this one.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "clv/data/frame.h"
#include "clv/stages/merge.h"
layout(local_size_x = CLV_GROUP_SIZE) in;
layout(std140, binding = CLV_BIND_FRAME) uniform FrameBlock { ClvFrame frame; };
layout(std140, binding = CLV_BIND_LEVEL) uniform LevelBlock { ClvLevelFrame level; };
layout(std140, binding = CLV_BIND_MERGE) uniform MergeBlock { ClvMergeSettings settings; };
layout(std430, binding = CLV_BIND_DYNAMICITY) buffer Dynamicity { uint dynamicity[]; };
layout(std430, binding = CLV_BIND_KEPT_DYNAMICITY) buffer KeptDynamicity { float keptDynamicity[]; };
layout(std430, binding = CLV_BIND_SLOT_FRAMES) buffer SlotFrames { float slotFrames[]; };

void main() {
    uint i = clvItem(gl_GlobalInvocationID);
    if (i >= frame.halves * level.slotCount) return;
    float largest = 0.0;
    for (uint k = 6u * i; k < 6u * i + 6u; ++k) {
        keptDynamicity[k] = clvMergeDynamicity(settings, keptDynamicity[k], clvFloatFromBits(dynamicity[k]));
        dynamicity[k] = 0u;
        largest = max(largest, keptDynamicity[k]);
    }
    slotFrames[i] = clvFramesFromWeight(clvMergeWeight(settings, largest, slotFrames[i] + 1.0));
}
