// The largest dynamicity of the rays that light each side of a slot in this frame.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "clv/data/frame.h"
#include "clv/stages/inject.h"
#include "clv/stages/record.h"
layout(constant_id = CLV_SPEC_RULE) const uint rule = 0u;
layout(constant_id = CLV_SPEC_TURNED) const uint turned = 0u;
layout(local_size_x = CLV_GROUP_SIZE) in;
layout(std140, binding = CLV_BIND_FRAME) uniform FrameBlock { ClvFrame frame; };
layout(std140, binding = CLV_BIND_LEVEL) uniform LevelBlock { ClvLevelFrame level; };
layout(std430, binding = CLV_BIND_RAYS) readonly buffer Rays { ClvRay rays[]; };
layout(std430, binding = CLV_BIND_TABLE) readonly buffer Table { uint table[]; };
layout(std430, binding = CLV_BIND_SPLITS) readonly buffer Splits { ClvSplit splits[]; };
layout(std430, binding = CLV_BIND_DYNAMICITY) buffer Dynamicity { uint dynamicity[]; };

ClvSplit clvReadSplit(uint i) { return splits[i]; }
#include "clv/stages/find_slot.h"

void main() {
    uint i = clvItem(gl_GlobalInvocationID);
    if (i >= frame.rayCount) return;
    ClvRay ray = rays[i];
    if (!(ray.dynamicity > 0.0) || !clvCarriesLight(ray)) return;
    uint halfIndex = i / (frame.rayCount / frame.halves);
    ClvCoefficients sides = clvDepositCoefficients(kClvStorageCube, clvKeptDirection(frame, turned, ray.direction));
    ClvWalk walk = clvWalkBegin(level.volume, ray);
    while (walk.running == 1) {
        ClvCrossing crossing = clvWalkStep(walk, ray.direction);
        uint entry = table[clvCellIndex(level.volume, crossing.cell)];
        if (entry == kClvNoSlot || !(clvCrossingWeight(rule, crossing, level.volume.cellSize) > 0.0)) continue;
        float middle = 0.5 * (crossing.tBegin + crossing.tEnd) * level.volume.cellSize;
        uint first = 6u * (halfIndex * level.slotCount + clvSlotAtPosition(entry, ray.origin + ray.direction * middle));
        for (uint side = 0u; side < 6u; ++side) {
            // The bits of floats above 0 rise with them.
            if (clvCoefficient(sides, side) > 0.0) atomicMax(dynamicity[first + side], clvBitsFromFloat(ray.dynamicity));
        }
    }
}
