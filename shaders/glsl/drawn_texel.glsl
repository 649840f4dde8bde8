// What a light's ray finds, in pictures of its triangles. The entry point includes before: triangles.glsl, and surface.glsl or textured_surface.glsl.
layout(std430, binding = CLV_BIND_MAP_FACES) readonly buffer Faces { ClvMapFace faces[]; };
layout(binding = CLV_BIND_FACE_TRIANGLES) uniform utexture2DArray faceTriangles;

ClvMapFace clvReadMapFace(uint index) { return faces[index]; }
uint clvReadFaceTriangle(uvec2 texel, uint face) { return texelFetch(faceTriangles, ivec3(texel, face), 0).x; }
#include "clv/stages/rsm_from_faces.h"

ClvRsmTexel texelOfRay(ClvFrame frame, uint light, ClvRay ray, float share) {
    ClvFaceHit seen = clvMeetInFaces(light, frame.faceCount, frame.faceSide, ray);
    return clvRsmTexelFromHit(seen.ray, surfaceHit(seen.met, seen.ray.direction), share);
}
