// Writes each ray into the lists of the bricks that it crosses.
#include "brick_walk.hlsli"

[[vk::binding(CLV_BIND_BRICK_RAYS)]] RWStructuredBuffer<uint> brickRays;

void visitBrick(uint list, uint ray) {
    uint place;
    InterlockedAdd(cursors[list], 1u, place);
    brickRays[place] = ray;
}
