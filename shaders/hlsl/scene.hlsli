// What a ray meets. The entry point includes before: bvh.hlsli, and surface.hlsli or textured_surface.hlsli.
ClvHit sceneHit(ClvRay ray) { return surfaceHit(nearestTriangle(ray.origin, ray.direction, ray.maxDistance), ray.direction); }
