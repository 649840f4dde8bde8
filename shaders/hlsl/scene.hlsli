// What a ray meets. The entry point includes before: surface.hlsli or textured_surface.hlsli.
ClvHit sceneHit(ClvRay ray) { return surfaceHit(clvTraceBvh(ray.origin, ray.direction, ray.maxDistance), ray.direction); }
