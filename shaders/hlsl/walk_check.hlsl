// What the walk of each ray adds up to: for tests of a device.
#include "clv/data/frame.h"
#include "clv/stages/walk_check.h"

[[vk::binding(CLV_BIND_FRAME)]] cbuffer FrameBlock { ClvFrame frame; };
[[vk::binding(CLV_BIND_LEVEL)]] cbuffer LevelBlock { ClvLevelFrame level; };
[[vk::binding(CLV_BIND_RAYS)]] Buffer<float4> rays;
[[vk::binding(CLV_BIND_WALK_CHECKS)]] RWStructuredBuffer<ClvWalkCheck> checks;

[numthreads(CLV_GROUP_SIZE, 1, 1)]
void main(uint3 thread : SV_DispatchThreadID) {
    uint i = clvItem(thread);
    if (i >= frame.rayCount) return;
    int row = int(3u * i);
    ClvRay ray = clvRayFromRows(rays.Load(row), rays.Load(row + 1), rays.Load(row + 2));
    checks[i] = clvCheckWalk(level.volume, ray);
}
