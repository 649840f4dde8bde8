// The scene's triangles in an acceleration structure, and ray queries among them: the other way to trace, with GL_EXT_ray_query.
#include "clv/math/finite.h"
#include "triangles.glsl"

layout(binding = CLV_BIND_ACCELERATION) uniform accelerationStructureEXT acceleration;

// The nearest triangle on the ray's way. The query finds which; the shared function says where, so that both ways to trace give the
// same distance. Only where the two disagree about an edge is the hit the query's own.
ClvBvhHit nearestTriangle(vec3 origin, vec3 direction, float maxDistance) {
    ClvBvhHit none = clvNoTriangle(maxDistance);
    if (!(maxDistance > 0.0) || !clvIsFinite(origin) || !clvIsFinite(direction)) return none;
    rayQueryEXT query;
    rayQueryInitializeEXT(query, acceleration, gl_RayFlagsOpaqueEXT, 0xff, origin, 1.0 / kClvFar, direction, maxDistance);
    while (rayQueryProceedEXT(query)) {}
    if (rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionNoneEXT) return none;
    uint index = uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, true));
    ClvBvhHit met = clvMeetTriangle(index, origin, direction, none);
    if (met.primitive != kClvNoPrimitive) return met;
    vec2 corners = rayQueryGetIntersectionBarycentricsEXT(query, true);
    met.distance = rayQueryGetIntersectionTEXT(query, true);
    met.primitive = clvSceneIndexOf(clvReadTriangle(index * kClvTriangleRows).w, clvReadTriangle(index * kClvTriangleRows + 1u).w);
    met.u = corners.x;
    met.v = corners.y;
    return met;
}
