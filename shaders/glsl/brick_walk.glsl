// Body of brick_count and brick_list: visits the bricks that each ray crosses and that have slots. The entry point defines visitBrick.
#include "clv/data/frame.h"
#include "clv/stages/bricks.h"
#include "clv/stages/inject.h"

layout(local_size_x = CLV_GROUP_SIZE) in;
layout(std140, binding = CLV_BIND_FRAME) uniform FrameBlock { ClvFrame frame; };
layout(std140, binding = CLV_BIND_LEVEL) uniform LevelBlock { ClvLevelFrame level; };
layout(binding = CLV_BIND_RAYS) uniform samplerBuffer rays;
layout(std430, binding = CLV_BIND_BRICK_MASK) readonly buffer Mask { uint mask[]; };
layout(std430, binding = CLV_BIND_BRICK_CURSORS) buffer Cursors { uint cursors[]; };

// list: of the brick's rays in this half.
void visitBrick(uint list, uint ray);

void main() {
    uint i = clvItem(gl_GlobalInvocationID);
    if (i >= frame.rayCount) return;
    uint first = i / (frame.rayCount / frame.halves) * level.brickCount;
    ClvVolume bricks = clvBrickVolume(level.volume);
    int row = int(3u * i);
    ClvRay ray = clvRayFromRows(texelFetch(rays, row), texelFetch(rays, row + 1), texelFetch(rays, row + 2));
    ClvWalk walk = clvWalkBegin(bricks, ray);
    while (walk.running == 1) {
        ClvCrossing crossing = clvWalkStep(walk, ray.direction);
        uint brick = clvCellIndex(bricks, crossing.cell);
        bool hasSlots = (mask[brick / 32u] >> (brick % 32u) & 1u) != 0u;
        if (hasSlots && crossing.tEnd > crossing.tBegin) visitBrick(first + brick, i);
    }
}
