// A ray and one triangle of a scene.
//
// A shader defines, before it includes this: vec4 clvReadTriangle(uint row).
#ifndef CLV_STAGES_MEET_TRIANGLE_H
#define CLV_STAGES_MEET_TRIANGLE_H
#include "../data/bvh.h"
#include "../data/hit.h"
CLV_NAMESPACE_BEGIN

struct ClvBvhHit {
    float distance;  // m, > 0; how far the ray reaches where nothing was met
    uint primitive;  // index of the triangle in the scene; kClvNoPrimitive where nothing was met
    float u;         // barycentric coordinates of the second and the third corner
    float v;
};

CLV_FN ClvBvhHit clvNoTriangle(float maxDistance) {
    ClvBvhHit hit;
    hit.distance = maxDistance;
    hit.primitive = kClvNoPrimitive;
    hit.u = 0.0f;
    hit.v = 0.0f;
    return hit;
}

// `best`, or the triangle at `index` in the order of the leaves if the ray meets it nearer: Moller and Trumbore (1997) with the
// distance from the triangle's normal, which keeps the hit on the surface of long thin triangles, too.
CLV_READER_FN ClvBvhHit clvMeetTriangle(CLV_READER uint index, vec3 origin, vec3 direction, ClvBvhHit best) {
    vec4 row0 = CLV_READ clvReadTriangle(index * kClvTriangleRows);
    vec4 row1 = CLV_READ clvReadTriangle(index * kClvTriangleRows + 1u);
    vec4 row2 = CLV_READ clvReadTriangle(index * kClvTriangleRows + 2u);
    vec3 edge1 = vec3(row1.x, row1.y, row1.z);
    vec3 edge2 = vec3(row2.x, row2.y, row2.z);
    vec3 toCorner = vec3(row0.x, row0.y, row0.z) - origin;
    vec3 normal = cross(edge1, edge2);
    vec3 moment = cross(toCorner, direction);
    float inverse = 1.0f / dot(normal, direction);
    float u = dot(moment, edge2) * inverse;
    float v = -dot(moment, edge1) * inverse;
    float distance = dot(normal, toCorner) * inverse;
    // A ray in the triangle's plane gives infinities or NaN, which do not pass all of these.
    if (u >= 0.0f && v >= 0.0f && u + v <= 1.0f && distance > 0.0f && distance < best.distance) {
        best.distance = distance;
        best.primitive = clvSceneIndexOf(row0.w, row1.w);
        best.u = u;
        best.v = v;
    }
    return best;
}

// Position of corner 0, 1 or 2, m.
CLV_READER_FN vec3 clvCornerOfTriangle(CLV_READER uint index, uint corner) {
    vec4 first = CLV_READ clvReadTriangle(index * kClvTriangleRows);
    if (corner == 0u) return vec3(first.x, first.y, first.z);
    vec4 edge = CLV_READ clvReadTriangle(index * kClvTriangleRows + corner);
    return vec3(first.x + edge.x, first.y + edge.y, first.z + edge.z);
}

CLV_NAMESPACE_END
#endif
