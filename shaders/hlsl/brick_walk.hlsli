// Body of brick_count and brick_list: visits the bricks that each ray crosses and that have slots. The entry point defines visitBrick.
#include "clv/data/frame.h"
#include "clv/stages/bricks.h"
#include "clv/stages/inject.h"

[[vk::binding(CLV_BIND_FRAME)]] cbuffer FrameBlock { ClvFrame frame; };
[[vk::binding(CLV_BIND_LEVEL)]] cbuffer LevelBlock { ClvLevelFrame level; };
[[vk::binding(CLV_BIND_RAYS)]] Buffer<float4> rays;
[[vk::binding(CLV_BIND_BRICK_MASK)]] StructuredBuffer<uint> mask;
[[vk::binding(CLV_BIND_BRICK_CURSORS)]] RWStructuredBuffer<uint> cursors;

// list: of the brick's rays in this half.
void visitBrick(uint list, uint ray);

[numthreads(CLV_GROUP_SIZE, 1, 1)]
void main(uint3 thread : SV_DispatchThreadID) {
    uint i = clvItem(thread);
    if (i >= frame.rayCount) return;
    uint first = i / (frame.rayCount / frame.halves) * level.brickCount;
    ClvVolume bricks = clvBrickVolume(level.volume);
    int row = int(3u * i);
    ClvRay ray = clvRayFromRows(rays.Load(row), rays.Load(row + 1), rays.Load(row + 2));
    ClvWalk walk = clvWalkBegin(bricks, ray);
    while (walk.running == 1) {
        ClvCrossing crossing = clvWalkStep(walk, ray.direction);
        uint brick = clvCellIndex(bricks, crossing.cell);
        bool hasSlots = (mask[brick / 32u] >> (brick % 32u) & 1u) != 0u;
        if (hasSlots && crossing.tEnd > crossing.tBegin) visitBrick(first + brick, i);
    }
}
