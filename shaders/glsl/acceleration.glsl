// The scene's triangles in an acceleration structure, which the graphics API searches: the other ways to trace.
#include "clv/math/finite.h"
#include "triangles.glsl"
#include "found_triangle.glsl"

layout(binding = CLV_BIND_ACCELERATION) uniform accelerationStructureEXT acceleration;

// The nearest triangle on the ray's way, for which the file that includes this one asks the API; origin, direction and maxDistance are sound.
FoundTriangle findTriangle(vec3 origin, vec3 direction, float maxDistance);

// The API finds which triangle is nearest; the shared function says where, so that all ways to trace give the same distance. Only where
// the two disagree about an edge is the hit the API's own.
ClvBvhHit nearestTriangle(vec3 origin, vec3 direction, float maxDistance) {
    ClvBvhHit none = clvNoTriangle(maxDistance);
    if (!(maxDistance > 0.0) || !clvIsFinite(origin) || !clvIsFinite(direction)) return none;
    FoundTriangle found = findTriangle(origin, direction, maxDistance);
    if (found.index == kClvNoPrimitive) return none;
    ClvBvhHit met = clvMeetTriangle(found.index, origin, direction, none);
    if (met.primitive != kClvNoPrimitive) return met;
    met.distance = found.distance;
    met.primitive = clvSceneIndexOf(clvReadTriangle(found.index * kClvTriangleRows).w, clvReadTriangle(found.index * kClvTriangleRows + 1u).w);
    met.u = found.corners.x;
    met.v = found.corners.y;
    return met;
}
