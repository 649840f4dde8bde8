// The tree of boxes and its triangles, and the walk through them.
layout(binding = CLV_BIND_BVH_BOXES) uniform samplerBuffer bvhBoxes;
layout(binding = CLV_BIND_BVH_CHILDREN) uniform usamplerBuffer bvhChildren;
layout(binding = CLV_BIND_TRIANGLES) uniform samplerBuffer triangles;

vec4 clvReadBvhBoxes(uint row) { return texelFetch(bvhBoxes, int(row)); }
uvec4 clvReadBvhChildren(uint node) { return texelFetch(bvhChildren, int(node)); }
vec4 clvReadTriangle(uint row) { return texelFetch(triangles, int(row)); }
#include "clv/stages/trace_bvh.h"
