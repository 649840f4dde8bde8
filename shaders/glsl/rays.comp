// A ray from a texel that is drawn in proportion to its flux.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "clv/data/frame.h"
#include "clv/data/gpu_bindings.h"
#include "clv/math/sobol.h"
#include "clv/stages/rays.h"

layout(local_size_x = CLV_GROUP_SIZE) in;
layout(std140, binding = CLV_BIND_FRAME) uniform FrameBlock { ClvFrame frame; };
layout(std430, binding = CLV_BIND_TEXELS) readonly buffer Texels { ClvRsmTexel texels[]; };
layout(std430, binding = CLV_BIND_TEXEL_SUMS) readonly buffer TexelSums { float texelSums[]; };
layout(std430, binding = CLV_BIND_RAYS) writeonly buffer Rays { ClvRay rays[]; };

float clvReadTexelSum(uint i) { return texelSums[i]; }
#include "clv/stages/pick_texel.h"

void main() {
    uint i = clvItem(gl_GlobalInvocationID);
    if (i >= frame.rayCount) return;
    uint perHalf = frame.rayCount / frame.halves;
    vec4 u = clvSobol4(frame.firstIndex + i / perHalf * perHalf + clvNeighbourIndex(i % perHalf, perHalf), frame.seed);
    ClvTexelPick pick = clvPickTexel(frame.rsmSide, frame.texelRows, vec2(u.x, u.y));
    ClvRay ray = clvDeadRay();
    if (pick.probability > 0.0) ray = clvRayFromTexel(texels[pick.texel], vec2(u.z, u.w), 1.0 / pick.probability, frame.originOffset);
    rays[i] = ray;
}
