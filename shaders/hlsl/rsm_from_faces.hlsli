// Body of rsm_from_faces and rsm_from_faces_textured: a texel of each light's reflective shadow map, found in pictures of its triangles.
[[vk::binding(CLV_BIND_FRAME)]] cbuffer FrameBlock { ClvFrame frame; };
[[vk::binding(CLV_BIND_LIGHTS)]] StructuredBuffer<ClvLight> lights;
[[vk::binding(CLV_BIND_MAP_FACES)]] StructuredBuffer<ClvMapFace> faces;
[[vk::binding(CLV_BIND_FACE_TRIANGLES)]] Texture2DArray<uint> faceTriangles;
[[vk::binding(CLV_BIND_TEXELS)]] RWStructuredBuffer<ClvRsmTexel> texels;

ClvMapFace clvReadMapFace(uint index) { return faces[index]; }
uint clvReadFaceTriangle(uint2 texel, uint face) { return faceTriangles.Load(int4(texel, face, 0)).x; }
#include "clv/stages/rsm_from_faces.h"

[numthreads(CLV_GROUP_SIZE, 1, 1)]
void main(uint3 thread : SV_DispatchThreadID) {
    uint i = clvItem(thread);
    uint perLight = frame.rsmSide * frame.rsmSide;
    if (i >= frame.texelRows * frame.rsmSide) return;
    uint light = i / perLight;
    uint2 texel = uint2(i % frame.rsmSide, i % perLight / frame.rsmSide);
    float2 u = clvRsmSamplePoint(texel, frame.rsmSide, frame.rsmPass, clvHashCombine(frame.rsmSeed, light));
    ClvRay ray = clvLightRay(lights[light], u, frame.boundsLo, frame.boundsHi);
    ClvFaceHit seen = clvMeetInFaces(light, frame.faceCount, frame.faceSide, ray);
    texels[i] = clvRsmTexelFromHit(seen.ray, surfaceHit(seen.met, seen.ray.direction), 1.0 / float(perLight));
}
