// How many rays cross each brick.
#include "brick_walk.hlsli"

void visitBrick(uint list, uint ray) { InterlockedAdd(cursors[list], 1u); }
