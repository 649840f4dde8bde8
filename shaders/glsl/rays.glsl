// Body of rays and rays_guided: a ray from a texel that is drawn by the running sums. The entry point defines direct.
#include "clv/data/frame.h"
#include "clv/math/sobol.h"
#include "clv/stages/rays.h"
layout(local_size_x = CLV_GROUP_SIZE) in;
layout(std140, binding = CLV_BIND_FRAME) uniform FrameBlock { ClvFrame frame; };
layout(std430, binding = CLV_BIND_TEXELS) readonly buffer Texels { ClvRsmTexel texels[]; };
layout(std430, binding = CLV_BIND_TEXEL_SUMS) readonly buffer TexelSums { float texelSums[]; };
layout(std430, binding = CLV_BIND_RAYS) writeonly buffer Rays { ClvRay rays[]; };

float clvReadTexelSum(uint i) { return texelSums[i]; }
#include "clv/stages/pick_texel.h"

// The direction of ray `index`; returns by how much it is preferred to a cosine-distributed one. u: in [0, 1)^2.
float direct(ClvRsmTexel texel, vec2 u, uint index, out vec3 direction);

void main() {
    uint i = clvItem(gl_GlobalInvocationID);
    if (i >= frame.rayCount) return;
    uint perHalf = frame.rayCount / frame.halves;
    uint index = frame.firstIndex + i / perHalf * frame.halfStep + clvNeighbourIndex(i % perHalf, perHalf);
    vec4 u = clvSobol4(index, frame.seed);
    ClvTexelPick pick = clvPickTexel(frame.rsmSide, frame.texelRows, vec2(u.x, u.y));
    ClvRay ray = clvDeadRay();
    if (pick.probability > 0.0) {
        ClvRsmTexel texel = texels[pick.texel];
        vec3 direction;
        float probability = pick.probability * direct(texel, vec2(u.z, u.w), index, direction);
        ray = clvRayAlong(texel, direction, 1.0 / probability, frame.originOffset);
    }
    rays[i] = ray;
}
