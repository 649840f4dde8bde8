// What a ray meets. The entry point includes before: bvh.glsl, query.glsl or launch.glsl, and surface.glsl or textured_surface.glsl.
ClvHit sceneHit(ClvRay ray) { return surfaceHit(nearestTriangle(ray.origin, ray.direction, ray.maxDistance), ray.direction); }
