// The scene's triangles, and a ray that meets one.
layout(binding = CLV_BIND_TRIANGLES) uniform samplerBuffer triangles;
vec4 clvReadTriangle(uint row) { return texelFetch(triangles, int(row)); }
#include "clv/stages/meet_triangle.h"
