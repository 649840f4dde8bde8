// Body of the maps' passes: a texel of each light's reflective shadow map. The entry point includes before: traced_texel.hlsli or drawn_texel.hlsli.
[[vk::binding(CLV_BIND_FRAME)]] cbuffer FrameBlock { ClvFrame frame; };
[[vk::binding(CLV_BIND_LIGHTS)]] StructuredBuffer<ClvLight> lights;
[[vk::binding(CLV_BIND_TEXELS)]] RWStructuredBuffer<ClvRsmTexel> texels;

[numthreads(CLV_GROUP_SIZE, 1, 1)]
void main(uint3 thread : SV_DispatchThreadID) {
    uint i = clvItem(thread);
    uint perLight = frame.rsmSide * frame.rsmSide;
    if (i >= frame.texelRows * frame.rsmSide) return;
    uint light = i / perLight;
    uint2 texel = uint2(i % frame.rsmSide, i % perLight / frame.rsmSide);
    float2 u = clvRsmSamplePoint(texel, frame.rsmSide, frame.rsmPass, clvHashCombine(frame.rsmSeed, light));
    ClvRay ray = clvLightRay(lights[light], u, frame.boundsLo, frame.boundsHi);
    texels[i] = texelOfRay(frame, light, ray, 1.0 / float(perLight));
}
