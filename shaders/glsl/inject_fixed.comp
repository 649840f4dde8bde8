// Each ray adds to the slots that it crosses, in integers: the same to the last bit from run to run.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "clv/data/frame.h"
#include "clv/stages/inject.h"
#include "clv/stages/record.h"
layout(constant_id = CLV_SPEC_STORAGE) const uint storage = 0u;
layout(constant_id = CLV_SPEC_CHANNELS) const uint channels = 3u;
layout(constant_id = CLV_SPEC_RULE) const uint rule = 0u;
layout(constant_id = CLV_SPEC_STRIDE) const uint stride = 32u;
layout(local_size_x = CLV_GROUP_SIZE) in;
layout(std140, binding = CLV_BIND_FRAME) uniform FrameBlock { ClvFrame frame; };
layout(std140, binding = CLV_BIND_LEVEL) uniform LevelBlock { ClvLevelFrame level; };
layout(std430, binding = CLV_BIND_RAYS) readonly buffer Rays { ClvRay rays[]; };
layout(std430, binding = CLV_BIND_TABLE) readonly buffer Table { uint table[]; };
layout(std430, binding = CLV_BIND_SPLITS) readonly buffer Splits { ClvSplit splits[]; };
layout(std430, binding = CLV_BIND_DEPOSITS) buffer Deposits { int deposits[]; };

ClvSplit clvReadSplit(uint i) { return splits[i]; }
#include "clv/stages/find_slot.h"

void main() {
    uint i = clvItem(gl_GlobalInvocationID);
    if (i >= frame.rayCount) return;
    uint halfIndex = i / (frame.rayCount / frame.halves);
    ClvRay ray = rays[i];
    ClvRecord record = clvRecordOfRay(storage, channels, ray);
    uint values = clvCoefficientCount(storage) * channels;
    ClvWalk walk = clvWalkBegin(level.volume, ray);
    while (walk.running == 1) {
        ClvCrossing crossing = clvWalkStep(walk, ray.direction);
        float weight = clvCrossingWeight(rule, crossing, level.volume.cellSize);
        uint entry = table[clvCellIndex(level.volume, crossing.cell)];
        if (entry == kClvNoSlot || !(weight > 0.0)) continue;
        float middle = 0.5 * (crossing.tBegin + crossing.tEnd) * level.volume.cellSize;
        uint first = (halfIndex * level.slotCount + clvSlotAtPosition(entry, ray.origin + ray.direction * middle)) * stride;
        for (uint k = 0u; k < values; ++k) {
            int value = clvFixedFromFloat(clvRecordValue(record, channels, k) * weight, level.fixedScale);
            if (value != 0) atomicAdd(deposits[first + k], value);
        }
    }
}
