// Body of texel_rows and texel_rows_guided: the running sums of one row of texels, a work group a row. Leaves the row's sum where the
// sums over all rows will lie. The entry point defines texelWeight.
#include "clv/data/frame.h"
#include "clv/stages/rays.h"
layout(local_size_x = CLV_GROUP_SIZE) in;
layout(std140, binding = CLV_BIND_FRAME) uniform FrameBlock { ClvFrame frame; };
layout(std430, binding = CLV_BIND_TEXELS) readonly buffer Texels { ClvRsmTexel texels[]; };
layout(std430, binding = CLV_BIND_TEXEL_SUMS) buffer TexelSums { float texelSums[]; };

// A texel's chance to be picked is in proportion to this.
float texelWeight(ClvRsmTexel texel);

uint row() { return clvItem(gl_GlobalInvocationID) / CLV_GROUP_SIZE; }
float readWeight(uint i) { return texelWeight(texels[row() * frame.rsmSide + i]); }
void writeSum(uint i, float sum) { texelSums[row() * (frame.rsmSide + 1) + i] = sum; }
#include "running_sums.glsl"

void main() {
    if (row() >= frame.texelRows) return;
    float sum = writeRunningSums(frame.rsmSide);
    uint overRows = frame.texelRows * (frame.rsmSide + 1);
    if (gl_LocalInvocationIndex == 0) texelSums[overRows + row() + 1] = sum;
}
