// Rays from texels and along directions that the guide prefers.
#include "rays.hlsli"
#include "guide.hlsli"

float direct(ClvRsmTexel texel, float2 u, uint index, out float3 direction) {
    ClvGuidedDirection guided = clvGuideDirection(clvGuideRowAt(guideGrid, texel.position), texel.normal, u, clvGuideChoice(index, frame.seed));
    direction = guided.direction;
    return guided.probability;
}
