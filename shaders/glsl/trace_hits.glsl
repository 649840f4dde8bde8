// Body of trace_hits and trace_hits_textured: cuts a ray at the first triangle that it meets, and says what that is. The entry point
// includes before: work_group.glsl or launch.glsl, and scene.glsl.
layout(std140, binding = CLV_BIND_FRAME) uniform FrameBlock { ClvFrame frame; };
layout(std430, binding = CLV_BIND_RAYS) buffer Rays { ClvRay rays[]; };
layout(std430, binding = CLV_BIND_HITS) writeonly buffer Hits { ClvHit hits[]; };

void main() {
    uint i = itemNumber();
    if (i >= frame.rayCount) return;
    ClvRay ray = rays[i];
    ClvHit hit = sceneHit(ray);
    rays[i].maxDistance = clvCutRay(ray, hit).maxDistance;
    hits[i] = hit;
}
