// The tree of boxes and its triangles, and the walk through them: one way to trace.
#include "triangles.hlsli"

[[vk::binding(CLV_BIND_BVH_BOXES)]] Buffer<float4> bvhBoxes;
[[vk::binding(CLV_BIND_BVH_CHILDREN)]] Buffer<uint4> bvhChildren;
float4 clvReadBvhBoxes(uint row) { return bvhBoxes.Load(int(row)); }
uint4 clvReadBvhChildren(uint node) { return bvhChildren.Load(int(node)); }
#include "clv/stages/trace_bvh.h"

// The nearest triangle on the ray's way.
ClvBvhHit nearestTriangle(float3 origin, float3 direction, float maxDistance) { return clvTraceBvh(origin, direction, maxDistance); }
