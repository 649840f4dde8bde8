// What a light's ray finds, in pictures of its triangles. The entry point includes before: triangles.hlsli, and surface.hlsli or textured_surface.hlsli.
[[vk::binding(CLV_BIND_MAP_FACES)]] StructuredBuffer<ClvMapFace> faces;
[[vk::binding(CLV_BIND_FACE_TRIANGLES)]] Texture2DArray<uint> faceTriangles;

ClvMapFace clvReadMapFace(uint index) { return faces[index]; }
uint clvReadFaceTriangle(uint2 texel, uint face) { return faceTriangles.Load(int4(texel, face, 0)).x; }
#include "clv/stages/rsm_from_faces.h"

ClvRsmTexel texelOfRay(ClvFrame frame, uint light, ClvRay ray, float share) {
    ClvFaceHit seen = clvMeetInFaces(light, frame.faceCount, frame.faceSide, ray);
    return clvRsmTexelFromHit(seen.ray, surfaceHit(seen.met, seen.ray.direction), share);
}
