// What a light's ray meets, found in the pictures that were drawn from the light (stages/map_face.h).
//
// A shader defines, before it includes this: vec4 clvReadTriangle(uint row), ClvMapFace clvReadMapFace(uint index), and
// uint clvReadFaceTriangle(uvec2 texel, uint face): 1 + the index of the triangle in sight in the order of the leaves, or 0.
#ifndef CLV_STAGES_RSM_FROM_FACES_H
#define CLV_STAGES_RSM_FROM_FACES_H
#include "map_face.h"
#include "meet_triangle.h"
CLV_NAMESPACE_BEGIN

struct ClvFaceHit {
    ClvBvhHit met;
    ClvRay ray;     // that met it
};

// Among the four texels around the ray, the nearest triangle that it meets. Where it slips between them, at an outline, it is moved
// to the middle of its own texel, so that no light is lost.
CLV_READER_FN ClvFaceHit clvMeetInFace(CLV_READER ClvMapFace face, uint layer, uint side, vec2 place, ClvRay ray) {
    uint last = side - 1u;
    uvec2 own = uvec2(min(uint(place.x), last), min(uint(place.y), last));
    uvec2 first = uvec2(uint(max(place.x - 0.5f, 0.0f)), uint(max(place.y - 0.5f, 0.0f)));
    ClvFaceHit hit;
    hit.ray = ray;
    hit.met = clvNoTriangle(ray.maxDistance);
    for (uint k = 0u; k < 4u; ++k) {
        uvec2 texel = uvec2(min(first.x + k % 2u, last), min(first.y + k / 2u, last));
        uint seen = CLV_READ clvReadFaceTriangle(texel, layer);
        if (seen != 0u) hit.met = clvMeetTriangle(CLV_PASS_READER seen - 1u, ray.origin, ray.direction, hit.met);
    }
    uint ownSeen = CLV_READ clvReadFaceTriangle(own, layer);
    if (hit.met.primitive != kClvNoPrimitive || ownSeen == 0u) return hit;
    hit.ray = clvFaceRay(face, ray, own, uvec2(side, side));
    hit.met = clvMeetTriangle(CLV_PASS_READER ownSeen - 1u, hit.ray.origin, hit.ray.direction, hit.met);
    return hit;
}

// The faces of a light are neighbours, in the order of the lights.
CLV_READER_FN ClvFaceHit clvMeetInFaces(CLV_READER uint light, uint faceCount, uint side, ClvRay ray) {
    for (uint layer = light; layer < faceCount; ++layer) {
        ClvMapFace face = CLV_READ clvReadMapFace(layer);
        if (face.light != light) continue;
        vec2 place = clvFaceTexel(face, ray, side);
        if (place.x >= 0.0f) return clvMeetInFace(CLV_PASS_READER face, layer, side, place, ray);
    }
    ClvFaceHit hit;
    hit.ray = ray;
    hit.met = clvNoTriangle(ray.maxDistance);
    return hit;
}

CLV_NAMESPACE_END
#endif
