// The running sums of one row of texels, by their flux and by what the guide prefers.
#include "texel_rows.hlsli"
#include "guide.hlsli"

float texelWeight(ClvRsmTexel texel) { return clvTexelWeight(texel) * clvGuideTexelWeight(clvGuideRowAt(guideGrid, texel.position)); }
