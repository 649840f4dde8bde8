// Irradiance at receivers that stand still, from the slots and weights that the host found for them.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "clv/data/frame.h"
#include "clv/stages/evaluate.h"
layout(constant_id = CLV_SPEC_STORAGE) const uint storage = 0u;
layout(constant_id = CLV_SPEC_CHANNELS) const uint channels = 3u;
layout(constant_id = CLV_SPEC_STRIDE) const uint stride = 32u;
layout(constant_id = CLV_SPEC_TURNED) const uint turned = 0u;
layout(local_size_x = CLV_GROUP_SIZE) in;
layout(std140, binding = CLV_BIND_FRAME) uniform FrameBlock { ClvFrame frame; };
layout(std140, binding = CLV_BIND_LEVEL) uniform LevelBlock { ClvLevelFrame level; };
layout(std430, binding = CLV_BIND_RECEIVERS) readonly buffer Receivers { ClvReceiver receivers[]; };
layout(std430, binding = CLV_BIND_LOOKUP_ENDS) readonly buffer Ends { uint ends[]; };
layout(std430, binding = CLV_BIND_LOOKUP_SLOTS) readonly buffer Slots { uint slots[]; };
layout(std430, binding = CLV_BIND_LOOKUP_WEIGHTS) readonly buffer Weights { float weights[]; };
layout(binding = CLV_BIND_HISTORY) uniform samplerBuffer history;
layout(std430, binding = CLV_BIND_IRRADIANCE) writeonly buffer Irradiance { vec4 irradiance[]; };

vec4 clvReadHistory(uint row) { return texelFetch(history, int(row)); }
#include "clv/stages/read_record.h"

void main() {
    uint i = clvItem(gl_GlobalInvocationID);
    if (i >= frame.halves * frame.receiverCount) return;
    uint receiver = i % frame.receiverCount;
    uint firstSlot = i / frame.receiverCount * level.slotCount;
    ClvCoefficients read = clvReadCoefficients(storage, clvKeptDirection(frame, turned, receivers[receiver].normal));
    vec3 sum = vec3(0.0);
    for (uint k = receiver == 0u ? 0u : ends[receiver - 1u]; k < ends[receiver]; ++k) {
        sum += clvReadRecord(firstSlot + slots[k], storage, channels, stride, read) * weights[k];
    }
    irradiance[i] = vec4(clvIrradianceFromSum(sum), 0.0);
}
