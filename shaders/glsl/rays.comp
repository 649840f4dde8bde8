// Rays from texels that are drawn in proportion to their flux, cosine-distributed.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "rays.glsl"

float direct(ClvRsmTexel texel, vec2 u, uint index, out vec3 direction) {
    direction = clvCosineFromSquare(u, texel.normal);
    return 1.0;
}
