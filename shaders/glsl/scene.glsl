// What a ray meets. The entry point includes before: surface.glsl or textured_surface.glsl.
ClvHit sceneHit(ClvRay ray) { return surfaceHit(clvTraceBvh(ray.origin, ray.direction, ray.maxDistance), ray.direction); }
