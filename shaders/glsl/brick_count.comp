// How many rays cross each brick.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "brick_walk.glsl"

void visitBrick(uint list, uint ray) { atomicAdd(cursors[list], 1u); }
