// Answers that a ray meets no triangle.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_ray_tracing : require
#include "clv/data/hit.h"
#include "found_triangle.glsl"

layout(location = 0) rayPayloadInEXT FoundTriangle answer;

void main() { answer.index = kClvNoPrimitive; }
