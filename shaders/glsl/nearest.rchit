// Answers with the nearest triangle that a ray meets.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_ray_tracing : require
#include "found_triangle.glsl"

layout(location = 0) rayPayloadInEXT FoundTriangle answer;
hitAttributeEXT vec2 corners;

void main() {
    answer.distance = gl_HitTEXT;
    answer.index = uint(gl_PrimitiveID);
    answer.corners = corners;
}
