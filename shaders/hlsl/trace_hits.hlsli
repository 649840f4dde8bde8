// Body of trace_hits and trace_hits_textured: cuts a ray at the first triangle that it meets, and says what that is.
[[vk::binding(CLV_BIND_FRAME)]] cbuffer FrameBlock { ClvFrame frame; };
[[vk::binding(CLV_BIND_RAYS)]] RWStructuredBuffer<ClvRay> rays;
[[vk::binding(CLV_BIND_HITS)]] RWStructuredBuffer<ClvHit> hits;

[numthreads(CLV_GROUP_SIZE, 1, 1)]
void main(uint3 thread : SV_DispatchThreadID) {
    uint i = clvItem(thread);
    if (i >= frame.rayCount) return;
    ClvRay ray = rays[i];
    ClvHit hit = sceneHit(ray);
    rays[i].maxDistance = clvCutRay(ray, hit).maxDistance;
    hits[i] = hit;
}
