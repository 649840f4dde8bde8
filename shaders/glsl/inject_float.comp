// Each ray adds to the slots that it crosses, by atomic additions of floats.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_atomic_float : require
#include "inject_rays.glsl"

layout(std430, binding = CLV_BIND_DEPOSITS) buffer Deposits { float deposits[]; };

void addDeposit(uint index, float value) {
    if (value != 0.0) atomicAdd(deposits[index], value);
}
