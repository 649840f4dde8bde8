// For tests of a device: where each ray's walk enters and leaves the grid, how many cells it crosses, and its faults: cells that are not the
// next one forwards, pieces that do not begin where the one before ended.
#include "clv/data/frame.h"
#include "clv/stages/inject.h"

[[vk::binding(CLV_BIND_FRAME)]] cbuffer FrameBlock { ClvFrame frame; };
[[vk::binding(CLV_BIND_LEVEL)]] cbuffer LevelBlock { ClvLevelFrame level; };
[[vk::binding(CLV_BIND_RAYS)]] Buffer<float4> rays;
[[vk::binding(CLV_BIND_IRRADIANCE)]] RWStructuredBuffer<float4> checks;

[numthreads(CLV_GROUP_SIZE, 1, 1)]
void main(uint3 thread : SV_DispatchThreadID) {
    uint i = clvItem(thread);
    if (i >= frame.rayCount) return;
    int row = int(3u * i);
    ClvRay ray = clvRayFromRows(rays.Load(row), rays.Load(row + 1), rays.Load(row + 2));
    ClvWalk walk = clvWalkBegin(level.volume, ray);
    int most = level.volume.resolution.x + level.volume.resolution.y + level.volume.resolution.z;
    int cells = 0;
    uint faults = 0u;
    float begin = walk.running == 1 ? walk.t : 0.0f;
    float end = begin;
    int3 last = walk.cell;
    while (walk.running == 1 && cells <= most) {
        ClvCrossing crossing = clvWalkStep(walk, ray.direction);
        int3 moved = crossing.cell - last;
        float3 forwards = float3(moved) * ray.direction;
        int away = abs(moved.x) + abs(moved.y) + abs(moved.z);
        bool next = cells == 0 ? away == 0 : away == 1 && forwards.x + forwards.y + forwards.z > 0.0f;
        bool joined = crossing.tBegin == end && crossing.tEnd >= crossing.tBegin;
        if (!next || !joined || clvCellInside(level.volume, crossing.cell) == 0) ++faults;
        last = crossing.cell;
        end = crossing.tEnd;
        ++cells;
    }
    if (walk.running == 1) ++faults;
    checks[i] = float4(begin, end, float(cells), float(faults));
}
