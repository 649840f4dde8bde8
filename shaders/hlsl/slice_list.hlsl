// Writes each ray into the lists of the slices that it crosses; a list has room for every ray.
#include "clv/data/frame.h"
#include "clv/stages/slices.h"

[[vk::binding(CLV_BIND_FRAME)]] cbuffer FrameBlock { ClvFrame frame; };
[[vk::binding(CLV_BIND_LEVEL)]] cbuffer LevelBlock { ClvLevelFrame level; };
[[vk::binding(CLV_BIND_RAYS)]] Buffer<float4> rays;
[[vk::binding(CLV_BIND_SLICE_DRAWS)]] RWStructuredBuffer<uint> draws;
[[vk::binding(CLV_BIND_SLICE_RAYS)]] RWStructuredBuffer<uint> sliceRays;

[numthreads(CLV_GROUP_SIZE, 1, 1)]
void main(uint3 thread : SV_DispatchThreadID) {
    uint i = clvItem(thread);
    if (i >= frame.rayCount) return;
    uint perHalf = frame.rayCount / frame.halves;
    uint firstLayer = i / perHalf * uint(level.volume.resolution.z);
    int row = int(3u * i);
    ClvRay ray = clvRayFromRows(rays.Load(row), rays.Load(row + 1), rays.Load(row + 2));
    ClvSlices slices = clvSlicesOfRay(level.volume, ray);
    for (int k = 0; k < slices.count; ++k) {
        int slice = slices.first + k * slices.step;
        if (!clvPieceIsDrawn(clvSlicePiece(level.volume, ray, slice))) continue;
        uint layer = firstLayer + uint(slice);
        uint vertices;
        InterlockedAdd(draws[4u * layer], 2u, vertices);
        sliceRays[layer * perHalf + vertices / 2u] = i;
    }
}
