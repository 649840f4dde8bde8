// Rays from texels and along directions that the guide prefers.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "rays.glsl"
#include "guide.glsl"

float direct(ClvRsmTexel texel, vec2 u, uint index, out vec3 direction) {
    ClvGuidedDirection guided = clvGuideDirection(clvGuideRowAt(guideGrid, texel.position), texel.normal, u, clvGuideChoice(index, frame.seed));
    direction = guided.direction;
    return guided.probability;
}
