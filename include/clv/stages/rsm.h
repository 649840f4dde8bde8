// The RSM stage: rays from a light through the texels of its reflective shadow map, and texels from what they hit.
// A square map a light, u in [0, 1)^2, whose texels all cover the same solid angle or area, so that the light's flux is exact at
// any resolution: concentric circles that fill the cone for a spot, the same on either hemisphere for a point light, or on the cap
// that the scene fills where that is smaller, and an orthographic map over the scene for a directional light.
// An engine that rasters its own map fills ClvRsmTexel in its own way: later stages do not know how texels lie.
#ifndef CLV_STAGES_RSM_H
#define CLV_STAGES_RSM_H
#include "../data/hit.h"
#include "../data/light.h"
#include "../data/ray.h"
#include "../data/rsm_texel.h"
#include "../math/sampling.h"
#include "../math/sobol.h"
CLV_NAMESPACE_BEGIN

// The point of the map, in [0, 1)^2, at which a texel is sampled: jittered within the texel, well spread over the passes, so
// that the mean over passes converges to the exact light, shadow edges included.
CLV_FN vec2 clvRsmSamplePoint(uvec2 texel, uint resolution, uint pass, uint seed) {
    uint texelSeed = clvHashCombine(seed, texel.y * resolution + texel.x);
    float x = (float(texel.x) + clvSobolUnit(pass, 0u, texelSeed)) / float(resolution);
    float y = (float(texel.y) + clvSobolUnit(pass, 1u, texelSeed)) / float(resolution);
    return vec2(x, y);
}

// Half the extents, m, of the box [lo, hi] seen along the axis (unit length).
CLV_FN float clvHalfExtentAlong(vec3 axis, vec3 lo, vec3 hi) { return 0.5f * dot(abs(axis), hi - lo); }

// Direction of unit length in a cap around `axis` (unit length), uniform by solid angle: heights under the pole are uniform
// (Archimedes). capHeight: 1 - cosine of the cap's half angle, (0, 2]; its solid angle is 2 pi capHeight. Returned is the part across
// the axis; `cosine` is the part along it.
CLV_FN vec3 clvAcrossCap(vec2 u, vec3 axis, float capHeight, CLV_OUT(float) cosine) {
    vec2 disk = clvDiskFromSquare(u);
    float height = capHeight * dot(disk, disk);
    cosine = 1.0f - height;
    // The sine over the disk's radius; clamped, because rounding can push a height above 2.
    float across = sqrt(capHeight * max(0.0f, 2.0f - height));
    vec3 tangent;
    vec3 bitangent;
    clvBasis(axis, tangent, bitangent);
    return tangent * (disk.x * across) + bitangent * (disk.y * across);
}
CLV_FN vec3 clvCapFromSquare(vec2 u, vec3 axis, float capHeight) {
    float cosine;
    vec3 across = clvAcrossCap(u, axis, capHeight, cosine);
    return normalize(axis * cosine + across);
}

// The point of the square that clvCapFromSquare maps to `direction`.
CLV_FN vec2 clvSquareFromCap(vec3 direction, vec3 axis, float capHeight) {
    vec3 tangent;
    vec3 bitangent;
    clvBasis(axis, tangent, bitangent);
    float x = dot(direction, tangent);
    float y = dot(direction, bitangent);
    float sine = sqrt(x * x + y * y);
    if (sine == 0.0f) return vec2(0.5f, 0.5f);
    // sin^2 / (1 + cos) is 1 - cos without its cancellation near the pole.
    float height = sine * sine / (1.0f + dot(direction, axis));
    float scale = sqrt(min(1.0f, height / capHeight)) / sine;
    return clvSquareFromDisk(vec2(x * scale, y * scale));
}

// Height of the cap of directions from `position` that holds the sphere around the box [lo, hi], m; 2, all directions, from within the
// sphere or near it.
CLV_FN float clvCapOfBox(vec3 position, vec3 lo, vec3 hi) {
    vec3 away = (lo + hi) * 0.5f - position;
    vec3 halfSize = (hi - lo) * 0.5f;
    float square = dot(halfSize, halfSize) / max(dot(away, away), 1.0e-30f);
    if (!(square < 0.5f)) return 2.0f;
    // 1 - cos by the sine; a hundredth more for what rounding and the corners of texels cut off.
    float sine = 1.01f * sqrt(square);
    return sine * sine / (1.0f + sqrt(1.0f - sine * sine));
}

// The sphere around the box [lo, hi], and a little more.
CLV_FN float clvRadiusOfBox(vec3 lo, vec3 hi) { return 0.505f * length(hi - lo); }

// A ray from afar in the cap around `axis`, the direction from `position` to the middle of the box. It begins before the sphere around the
// box, so that what it meets has the accuracy of the scene, not that of the light's distance; and what it misses the middle by
// follows from the map, so that rays spread evenly over the scene from 1e9 times its size, too.
CLV_FN void clvRayFromAfar(vec2 u, vec3 position, float capHeight, vec3 lo, vec3 hi, CLV_OUT(vec3) origin, CLV_OUT(vec3) direction) {
    vec3 center = (lo + hi) * 0.5f;
    vec3 away = center - position;
    float distance = length(away);
    vec3 axis = away / distance;
    float cosine;
    vec3 across = clvAcrossCap(u, axis, capHeight, cosine);
    direction = normalize(axis * cosine + across);
    origin = center + across * (distance / cosine) - direction * (clvRadiusOfBox(lo, hi) / cosine);
}

// A ray of a point light: one half of the map for each hemisphere; from afar the whole map for the scene alone.
CLV_FN ClvRay clvPointLightRay(ClvLight light, vec2 u, vec3 lo, vec3 hi) {
    float side = u.x < 0.5f ? 0.0f : 1.0f;
    float capHeight = clvCapOfBox(light.position, lo, hi);
    ClvRay ray;
    ray.origin = light.position;
    ray.maxDistance = kClvFar;
    if (capHeight < 2.0f) {
        clvRayFromAfar(u, light.position, capHeight, lo, hi, ray.origin, ray.direction);
    } else {
        ray.direction = clvCapFromSquare(vec2(2.0f * u.x - side, u.y), vec3(0.0f, 1.0f - 2.0f * side, 0.0f), 1.0f);
    }
    ray.dynamicity = light.dynamicity;
    ray.flux = light.intensity * (2.0f * kClvPi * capHeight);
    ray.pad0 = 0.0f;
    return ray;
}

// A ray of a spot light: the map is the cap of the sphere inside the outer cone, or the one that holds the scene where that is smaller.
CLV_FN ClvRay clvSpotLightRay(ClvLight light, vec2 u, vec3 lo, vec3 hi) {
    // 1 - cos(outer), without the cancellation that would spoil narrow cones.
    float halfSine = sin(0.5f * light.outerConeAngle);
    float coneHeight = 2.0f * halfSine * halfSine;
    float sceneHeight = clvCapOfBox(light.position, lo, hi);
    float capHeight = min(coneHeight, sceneHeight);
    ClvRay ray;
    ray.maxDistance = kClvFar;
    if (sceneHeight < coneHeight) {
        clvRayFromAfar(u, light.position, capHeight, lo, hi, ray.origin, ray.direction);
    } else {
        ray.direction = clvCapFromSquare(u, light.direction, capHeight);
        ray.origin = light.position;
        if (sceneHeight < 2.0f) {
            // From afar, too, it begins before the scene.
            vec3 away = (lo + hi) * 0.5f - light.position;
            float along = dot(away, ray.direction);
            float radius = clvRadiusOfBox(lo, hi);
            ray.origin += ray.direction * max(0.0f, along - radius);
        }
    }
    ray.dynamicity = light.dynamicity;
    float falloff = clvSpotFalloff(dot(ray.direction, light.direction), light.innerConeAngle, light.outerConeAngle);
    ray.flux = light.intensity * (2.0f * kClvPi * capHeight * falloff);
    ray.pad0 = 0.0f;
    return ray;
}

// A ray of a directional light: the map covers the box [lo, hi] (m), and rays start before it.
CLV_FN ClvRay clvDirectionalLightRay(ClvLight light, vec2 u, vec3 lo, vec3 hi) {
    vec3 tangent;
    vec3 bitangent;
    clvBasis(light.direction, tangent, bitangent);
    float halfWidth = clvHalfExtentAlong(tangent, lo, hi);
    float halfHeight = clvHalfExtentAlong(bitangent, lo, hi);
    // A flat scene may have no depth at all: the sum of its extents keeps the start off its surface.
    vec3 extent = hi - lo;
    float back = clvHalfExtentAlong(light.direction, lo, hi) + 0.01f * (extent.x + extent.y + extent.z);
    ClvRay ray;
    ray.origin = (lo + hi) * 0.5f - light.direction * back + tangent * ((2.0f * u.x - 1.0f) * halfWidth) +
                 bitangent * ((2.0f * u.y - 1.0f) * halfHeight);
    ray.maxDistance = kClvFar;
    ray.direction = light.direction;
    ray.dynamicity = light.dynamicity;
    ray.flux = light.intensity * (4.0f * halfWidth * halfHeight);
    ray.pad0 = 0.0f;
    return ray;
}

// The light's ray through point u of its map. Its flux is what the whole map would carry if it were lit as this point is:
// a texel's share is that divided by the number of texels. [lo, hi]: the scene's bounds, m.
CLV_FN ClvRay clvLightRay(ClvLight light, vec2 u, vec3 lo, vec3 hi) {
    if (light.type == kClvLightDirectional) return clvDirectionalLightRay(light, u, lo, hi);
    if (light.type == kClvLightSpot) return clvSpotLightRay(light, u, lo, hi);
    return clvPointLightRay(light, u, lo, hi);
}

// The texel that a light's ray makes where it hit; not valid where it met nothing. texelShare: 1 / number of texels.
CLV_FN ClvRsmTexel clvRsmTexelFromHit(ClvRay lightRay, ClvHit hit, float texelShare) {
    ClvRsmTexel texel;
    bool met = hit.distance < kClvFar;
    texel.position = lightRay.origin + lightRay.direction * (met ? hit.distance : 0.0f);
    texel.dynamicity = lightRay.dynamicity;
    texel.normal = hit.normal;
    texel.valid = met ? 1u : 0u;
    texel.flux = lightRay.flux * hit.albedo * texelShare;
    texel.pad0 = 0.0f;
    return texel;
}

CLV_NAMESPACE_END
#endif
