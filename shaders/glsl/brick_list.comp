// Writes each ray into the lists of the bricks that it crosses.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "brick_walk.glsl"

layout(std430, binding = CLV_BIND_BRICK_RAYS) writeonly buffer BrickRays { uint brickRays[]; };

void visitBrick(uint list, uint ray) { brickRays[atomicAdd(cursors[list], 1u)] = ray; }
