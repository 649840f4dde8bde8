// The running sums of one row of texels; a work group a row. Leaves the row's flux where the sums over all rows will lie.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "clv/data/frame.h"
#include "clv/data/rsm_texel.h"

layout(local_size_x = CLV_GROUP_SIZE) in;
layout(std140, binding = CLV_BIND_FRAME) uniform FrameBlock { ClvFrame frame; };
layout(std430, binding = CLV_BIND_TEXELS) readonly buffer Texels { ClvRsmTexel texels[]; };
layout(std430, binding = CLV_BIND_TEXEL_SUMS) buffer TexelSums { float texelSums[]; };

float clvReadTexelSum(uint i) { return texelSums[i]; }
#include "clv/stages/pick_texel.h"
uint row() { return clvItem(gl_GlobalInvocationID) / CLV_GROUP_SIZE; }
float readWeight(uint i) { return clvTexelWeight(texels[row() * frame.rsmSide + i]); }
void writeSum(uint i, float sum) { texelSums[row() * (frame.rsmSide + 1) + i] = sum; }
#include "running_sums.glsl"

void main() {
    if (row() >= frame.texelRows) return;
    float flux = writeRunningSums(frame.rsmSide);
    uint overRows = frame.texelRows * (frame.rsmSide + 1);
    if (gl_LocalInvocationIndex == 0) texelSums[overRows + row() + 1] = flux;
}
