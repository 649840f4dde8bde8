// The tree of boxes and its triangles, and the walk through them: one way to trace.
#include "triangles.glsl"

layout(binding = CLV_BIND_BVH_BOXES) uniform samplerBuffer bvhBoxes;
layout(binding = CLV_BIND_BVH_CHILDREN) uniform usamplerBuffer bvhChildren;
vec4 clvReadBvhBoxes(uint row) { return texelFetch(bvhBoxes, int(row)); }
uvec4 clvReadBvhChildren(uint node) { return texelFetch(bvhChildren, int(node)); }
#include "clv/stages/trace_bvh.h"

// The nearest triangle on the ray's way.
ClvBvhHit nearestTriangle(vec3 origin, vec3 direction, float maxDistance) { return clvTraceBvh(origin, direction, maxDistance); }
