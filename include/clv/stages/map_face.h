// The RSM stage where maps are drawn: flat pictures from the light say which triangle is in sight, and each texel of the map of
// stages/rsm.h takes what its own ray meets among the triangles that it finds there.
#ifndef CLV_STAGES_MAP_FACE_H
#define CLV_STAGES_MAP_FACE_H
#include "../data/ray.h"
CLV_NAMESPACE_BEGIN

// A picture of a square of directions, or of parallel rays; a point light has six of them.
struct ClvMapFace {     // 64 bytes
    vec3 origin;        // m: the light, or the middle of the plane from which parallel rays start
    uint light;         // index of the light
    vec3 right;         // coordinate x of an offset is its product with this; over that with `forward` where rays spread
    float depthScale;   // > 0: rays that spread: m, nothing nearer is seen; parallel ones: 1/m, 1 / the farthest distance
    vec3 up;            // the same for y
    uint parallel;      // 1: rays are parallel, 0: they spread
    vec3 forward;       // unit length
    float pad0;
};

// Place of a point in the picture, in clip space: y up, the depth 1 where nearest and 0 where farthest.
CLV_FN vec4 clvFacePosition(ClvMapFace face, vec3 position) {
    vec3 offset = position - face.origin;
    float along = dot(offset, face.forward);
    float x = dot(offset, face.right);
    float y = dot(offset, face.up);
    if (face.parallel == 1u) return vec4(x, y, 1.0f - along * face.depthScale, 1.0f);
    return vec4(x, y, face.depthScale, along);
}

// Texels at the rim of a picture, on each side, that only serve as neighbours: where faces of a light meet, both hold them.
CLV_CONST float kClvFaceRim = 1.0f;

// Where a light's ray appears, in texels of a picture of `side`^2 (side > 4), from its upper left corner; both are below 0 where it
// appears outside or far into the rim, in which case another face has it.
CLV_FN vec2 clvFaceTexel(ClvMapFace face, ClvRay ray, uint side) {
    vec3 offset = face.parallel == 1u ? ray.origin - face.origin : ray.direction;
    float along = face.parallel == 1u ? 1.0f : dot(offset, face.forward);
    float x = dot(offset, face.right);
    float y = dot(offset, face.up);
    float inside = along * (1.0f - 1.5f * kClvFaceRim / float(side));
    if (!(along > 0.0f) || abs(x) > inside || abs(y) > inside) return vec2(-1.0f, -1.0f);
    return vec2(0.5f + 0.5f * x / along, 0.5f - 0.5f * y / along) * float(side);
}

// `ray`, moved to the middle of the texel (column, row) of a picture of `size` texels.
CLV_FN ClvRay clvFaceRay(ClvMapFace face, ClvRay ray, uvec2 texel, uvec2 size) {
    float x = (2.0f * float(texel.x) + 1.0f) / float(size.x) - 1.0f;
    float y = 1.0f - (2.0f * float(texel.y) + 1.0f) / float(size.y);
    // Right and up are shorter or longer than 1: a coordinate of 1 is 1 / length away.
    vec3 across = face.right * (x / dot(face.right, face.right)) + face.up * (y / dot(face.up, face.up));
    if (face.parallel == 1u) {
        ray.origin = face.origin + across;
    } else {
        // As far from the light as it began.
        float skipped = dot(ray.origin - face.origin, ray.direction);
        ray.direction = normalize(face.forward + across);
        ray.origin = face.origin + ray.direction * skipped;
    }
    return ray;
}

CLV_NAMESPACE_END
#endif
