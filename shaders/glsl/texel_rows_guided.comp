// The running sums of one row of texels, by their flux and by what the guide prefers.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "texel_rows.glsl"
#include "guide.glsl"

float texelWeight(ClvRsmTexel texel) { return clvTexelWeight(texel) * clvGuideTexelWeight(clvGuideRowAt(guideGrid, texel.position)); }
