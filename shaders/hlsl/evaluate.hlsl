// Irradiance at receivers that stand still, from the slots and weights that the host found for them.
#include "clv/data/frame.h"
#include "clv/stages/evaluate.h"
[[vk::constant_id(CLV_SPEC_STORAGE)]] const uint storage = 0u;
[[vk::constant_id(CLV_SPEC_CHANNELS)]] const uint channels = 3u;
[[vk::constant_id(CLV_SPEC_STRIDE)]] const uint stride = 32u;
[[vk::constant_id(CLV_SPEC_TURNED)]] const uint turned = 0u;
[[vk::binding(CLV_BIND_FRAME)]] cbuffer FrameBlock { ClvFrame frame; };
[[vk::binding(CLV_BIND_LEVEL)]] cbuffer LevelBlock { ClvLevelFrame level; };
[[vk::binding(CLV_BIND_RECEIVERS)]] StructuredBuffer<ClvReceiver> receivers;
[[vk::binding(CLV_BIND_LOOKUP_ENDS)]] StructuredBuffer<uint> ends;
[[vk::binding(CLV_BIND_LOOKUP_SLOTS)]] StructuredBuffer<uint> slots;
[[vk::binding(CLV_BIND_LOOKUP_WEIGHTS)]] StructuredBuffer<float> weights;
[[vk::binding(CLV_BIND_HISTORY)]] Buffer<float4> history;
[[vk::binding(CLV_BIND_IRRADIANCE)]] RWStructuredBuffer<float4> irradiance;

float4 clvReadHistory(uint row) { return history.Load(int(row)); }
#include "clv/stages/read_record.h"

[numthreads(CLV_GROUP_SIZE, 1, 1)]
void main(uint3 thread : SV_DispatchThreadID) {
    uint i = clvItem(thread);
    if (i >= frame.halves * frame.receiverCount) return;
    uint receiver = i % frame.receiverCount;
    uint firstSlot = i / frame.receiverCount * level.slotCount;
    ClvCoefficients read = clvReadCoefficients(storage, clvKeptDirection(frame, turned, receivers[receiver].normal));
    float3 sum = float3(0.0, 0.0, 0.0);
    for (uint k = receiver == 0u ? 0u : ends[receiver - 1u]; k < ends[receiver]; ++k) {
        sum += clvReadRecord(firstSlot + slots[k], storage, channels, stride, read) * weights[k];
    }
    irradiance[i] = float4(clvIrradianceFromSum(sum), 0.0);
}
