// Body of inject_float and inject_fixed: each ray adds to the slots that it crosses. The entry point defines addDeposit.
#include "clv/data/frame.h"
#include "clv/stages/inject.h"
#include "clv/stages/record.h"
[[vk::constant_id(CLV_SPEC_STORAGE)]] const uint storage = 0u;
[[vk::constant_id(CLV_SPEC_CHANNELS)]] const uint channels = 3u;
[[vk::constant_id(CLV_SPEC_RULE)]] const uint rule = 0u;
[[vk::constant_id(CLV_SPEC_STRIDE)]] const uint stride = 32u;
[[vk::constant_id(CLV_SPEC_TURNED)]] const uint turned = 0u;
[[vk::binding(CLV_BIND_FRAME)]] cbuffer FrameBlock { ClvFrame frame; };
[[vk::binding(CLV_BIND_LEVEL)]] cbuffer LevelBlock { ClvLevelFrame level; };
[[vk::binding(CLV_BIND_RAYS)]] StructuredBuffer<ClvRay> rays;
[[vk::binding(CLV_BIND_TABLE)]] StructuredBuffer<uint> table;
[[vk::binding(CLV_BIND_SPLITS)]] StructuredBuffer<ClvSplit> splits;

ClvSplit clvReadSplit(uint i) { return splits[i]; }
#include "clv/stages/find_slot.h"

// Adds to one number of a record, W m.
void addDeposit(uint index, float value);

[numthreads(CLV_GROUP_SIZE, 1, 1)]
void main(uint3 thread : SV_DispatchThreadID) {
    uint i = clvItem(thread);
    if (i >= frame.rayCount) return;
    uint halfIndex = i / (frame.rayCount / frame.halves);
    ClvRay ray = rays[i];
    ClvRecord record = clvRecordOfRay(storage, channels, ray, clvKeptDirection(frame, turned, ray.direction), clvMostFlux(rule, level.volume.cellSize));
    uint values = clvCoefficientCount(storage) * channels;
    ClvWalk walk = clvWalkBegin(level.volume, ray);
    while (walk.running == 1) {
        ClvCrossing crossing = clvWalkStep(walk, ray.direction);
        float weight = clvCrossingWeight(rule, crossing, level.volume.cellSize);
        uint entry = table[clvCellIndex(level.volume, crossing.cell)];
        if (entry == kClvNoSlot || !(weight > 0.0)) continue;
        float middle = 0.5 * (crossing.tBegin + crossing.tEnd) * level.volume.cellSize;
        uint first = (halfIndex * level.slotCount + clvSlotAtPosition(entry, ray.origin + ray.direction * middle)) * stride;
        for (uint k = 0u; k < values; ++k) addDeposit(first + k, clvRecordValue(record, channels, k) * weight);
    }
}
