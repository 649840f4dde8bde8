// Cuts a ray at the first triangle that it meets.
#include "clv/data/frame.h"
#include "clv/data/ray.h"

[[vk::binding(CLV_BIND_FRAME)]] cbuffer FrameBlock { ClvFrame frame; };
[[vk::binding(CLV_BIND_RAYS)]] RWStructuredBuffer<ClvRay> rays;
#include "bvh.hlsli"

[numthreads(CLV_GROUP_SIZE, 1, 1)]
void main(uint3 thread : SV_DispatchThreadID) {
    uint i = clvItem(thread);
    if (i >= frame.rayCount) return;
    rays[i].maxDistance = nearestTriangle(rays[i].origin, rays[i].direction, rays[i].maxDistance).distance;
}
