// Ray queries among the scene's triangles, with GL_EXT_ray_query.
#include "acceleration.glsl"

FoundTriangle findTriangle(vec3 origin, vec3 direction, float maxDistance) {
    rayQueryEXT query;
    rayQueryInitializeEXT(query, acceleration, gl_RayFlagsOpaqueEXT, 0xff, origin, 1.0 / kClvFar, direction, maxDistance);
    while (rayQueryProceedEXT(query)) {}
    FoundTriangle found;
    found.index = kClvNoPrimitive;
    if (rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionNoneEXT) return found;
    found.distance = rayQueryGetIntersectionTEXT(query, true);
    found.index = uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, true));
    found.corners = rayQueryGetIntersectionBarycentricsEXT(query, true);
    return found;
}
