// Body of the maps' passes: a texel of each light's reflective shadow map. The entry point includes before: traced_texel.glsl or
// drawn_texel.glsl, and work_group.glsl or launch.glsl.
layout(std140, binding = CLV_BIND_FRAME) uniform FrameBlock { ClvFrame frame; };
layout(std430, binding = CLV_BIND_LIGHTS) readonly buffer Lights { ClvLight lights[]; };
layout(std430, binding = CLV_BIND_TEXELS) writeonly buffer Texels { ClvRsmTexel texels[]; };

void main() {
    uint i = itemNumber();
    uint perLight = frame.rsmSide * frame.rsmSide;
    if (i >= frame.texelRows * frame.rsmSide) return;
    uint light = i / perLight;
    uvec2 texel = uvec2(i % frame.rsmSide, i % perLight / frame.rsmSide);
    vec2 u = clvRsmSamplePoint(texel, frame.rsmSide, frame.rsmPass, clvHashCombine(frame.rsmSeed, light));
    ClvRay ray = clvLightRay(lights[light], u, frame.boundsLo, frame.boundsHi);
    texels[i] = texelOfRay(frame, light, ray, 1.0 / float(perLight));
}
