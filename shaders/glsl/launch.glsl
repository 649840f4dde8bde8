// Rays sent among the scene's triangles by a ray-tracing pipeline, with GL_EXT_ray_tracing: nearest.rchit or nearest.rmiss answers.
#include "acceleration.glsl"

layout(location = 0) rayPayloadEXT FoundTriangle answer;

FoundTriangle findTriangle(vec3 origin, vec3 direction, float maxDistance) {
    traceRayEXT(acceleration, gl_RayFlagsOpaqueEXT, 0xff, 0, 0, 0, origin, 1.0 / kClvFar, direction, maxDistance, 0);
    return answer;
}

// Number of this invocation's item.
uint itemNumber() { return clvItem(gl_LaunchIDEXT); }
