// Body of trace and trace_query: cuts a ray at the first triangle that it meets.
layout(local_size_x = CLV_GROUP_SIZE) in;
layout(std140, binding = CLV_BIND_FRAME) uniform FrameBlock { ClvFrame frame; };
layout(std430, binding = CLV_BIND_RAYS) buffer Rays { ClvRay rays[]; };

void main() {
    uint i = clvItem(gl_GlobalInvocationID);
    if (i >= frame.rayCount) return;
    rays[i].maxDistance = nearestTriangle(rays[i].origin, rays[i].direction, rays[i].maxDistance).distance;
}
