// The running sums of one row of texels, by their flux.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "texel_rows.glsl"

float texelWeight(ClvRsmTexel texel) { return clvTexelWeight(texel); }
