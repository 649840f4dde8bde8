// Body of trace, by each way: cuts a ray at the first triangle that it meets. The entry point includes before: work_group.glsl or launch.glsl.
layout(std140, binding = CLV_BIND_FRAME) uniform FrameBlock { ClvFrame frame; };
layout(std430, binding = CLV_BIND_RAYS) buffer Rays { ClvRay rays[]; };

void main() {
    uint i = itemNumber();
    if (i >= frame.rayCount) return;
    rays[i].maxDistance = nearestTriangle(rays[i].origin, rays[i].direction, rays[i].maxDistance).distance;
}
