// The running sums over all rows of texels, by one work group, in place of the rows' flux.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "clv/data/frame.h"

layout(local_size_x = CLV_GROUP_SIZE) in;
layout(std140, binding = CLV_BIND_FRAME) uniform FrameBlock { ClvFrame frame; };
layout(std430, binding = CLV_BIND_TEXEL_SUMS) buffer TexelSums { float texelSums[]; };

uint overRows() { return frame.texelRows * (frame.rsmSide + 1); }
float readWeight(uint i) { return texelSums[overRows() + i + 1]; }
void writeSum(uint i, float sum) { texelSums[overRows() + i] = sum; }
#include "running_sums.glsl"

void main() { writeRunningSums(frame.texelRows); }
