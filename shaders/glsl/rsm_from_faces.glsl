// Body of rsm_from_faces and rsm_from_faces_textured: a texel of each light's reflective shadow map, found in pictures of its triangles.
layout(local_size_x = CLV_GROUP_SIZE) in;
layout(std140, binding = CLV_BIND_FRAME) uniform FrameBlock { ClvFrame frame; };
layout(std430, binding = CLV_BIND_LIGHTS) readonly buffer Lights { ClvLight lights[]; };
layout(std430, binding = CLV_BIND_MAP_FACES) readonly buffer Faces { ClvMapFace faces[]; };
layout(binding = CLV_BIND_FACE_TRIANGLES) uniform utexture2DArray faceTriangles;
layout(std430, binding = CLV_BIND_TEXELS) writeonly buffer Texels { ClvRsmTexel texels[]; };

ClvMapFace clvReadMapFace(uint index) { return faces[index]; }
uint clvReadFaceTriangle(uvec2 texel, uint face) { return texelFetch(faceTriangles, ivec3(texel, face), 0).x; }
#include "clv/stages/rsm_from_faces.h"

void main() {
    uint i = clvItem(gl_GlobalInvocationID);
    uint perLight = frame.rsmSide * frame.rsmSide;
    if (i >= frame.texelRows * frame.rsmSide) return;
    uint light = i / perLight;
    uvec2 texel = uvec2(i % frame.rsmSide, i % perLight / frame.rsmSide);
    vec2 u = clvRsmSamplePoint(texel, frame.rsmSide, frame.rsmPass, clvHashCombine(frame.rsmSeed, light));
    ClvRay ray = clvLightRay(lights[light], u, frame.boundsLo, frame.boundsHi);
    ClvFaceHit seen = clvMeetInFaces(light, frame.faceCount, frame.faceSide, ray);
    texels[i] = clvRsmTexelFromHit(seen.ray, surfaceHit(seen.met, seen.ray.direction), 1.0 / float(perLight));
}
