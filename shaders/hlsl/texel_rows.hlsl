// The running sums of one row of texels, by their flux.
#include "texel_rows.hlsli"

float texelWeight(ClvRsmTexel texel) { return clvTexelWeight(texel); }
