// The scene's triangles, and a ray that meets one.
[[vk::binding(CLV_BIND_TRIANGLES)]] Buffer<float4> triangles;
float4 clvReadTriangle(uint row) { return triangles.Load(int(row)); }
#include "clv/stages/meet_triangle.h"
