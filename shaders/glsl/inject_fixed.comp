// Each ray adds to the slots that it crosses, in integers: the same to the last bit from run to run.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "inject_rays.glsl"

layout(std430, binding = CLV_BIND_DEPOSITS) buffer Deposits { uint deposits[]; };  // bits of integers, which wrap around at 2^32

void addDeposit(uint index, float value) {
    int units = clvFixedFromFloat(value, level.fixedScale);
    if (units != 0) atomicAdd(deposits[index], uint(units));
}
