// The largest dynamicity of the rays that light each side of a slot in this frame.
#include "clv/data/frame.h"
#include "clv/stages/inject.h"
#include "clv/stages/record.h"
[[vk::constant_id(CLV_SPEC_RULE)]] const uint rule = 0u;
[[vk::constant_id(CLV_SPEC_TURNED)]] const uint turned = 0u;
[[vk::binding(CLV_BIND_FRAME)]] cbuffer FrameBlock { ClvFrame frame; };
[[vk::binding(CLV_BIND_LEVEL)]] cbuffer LevelBlock { ClvLevelFrame level; };
[[vk::binding(CLV_BIND_RAYS)]] StructuredBuffer<ClvRay> rays;
[[vk::binding(CLV_BIND_TABLE)]] StructuredBuffer<uint> table;
[[vk::binding(CLV_BIND_SPLITS)]] StructuredBuffer<ClvSplit> splits;
[[vk::binding(CLV_BIND_DYNAMICITY)]] RWStructuredBuffer<uint> dynamicity;

ClvSplit clvReadSplit(uint i) { return splits[i]; }
#include "clv/stages/find_slot.h"

[numthreads(CLV_GROUP_SIZE, 1, 1)]
void main(uint3 thread : SV_DispatchThreadID) {
    uint i = clvItem(thread);
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
            if (clvCoefficient(sides, side) > 0.0) InterlockedMax(dynamicity[first + side], clvBitsFromFloat(ray.dynamicity));
        }
    }
}
