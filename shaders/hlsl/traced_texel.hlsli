// What a light's ray finds, by tracing. The entry point includes before: scene.hlsli and what that asks for.
ClvRsmTexel texelOfRay(ClvFrame frame, uint light, ClvRay ray, float share) { return clvRsmTexelFromHit(ray, sceneHit(ray), share); }
