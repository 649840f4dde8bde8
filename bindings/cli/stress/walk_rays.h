// Rays that a walk through a grid may stumble over: along axes and edges, through corners, from and to boundaries, short, endless.
#pragma once
#include <algorithm>
#include <cmath>

#include "clv/data/light_volume.h"
#include "clv/data/ray.h"
#include "clv/math/hash.h"

namespace clv {

// Numbers drawn one after the other.
class Random {
public:
    explicit Random(std::uint32_t seed) : state_(clvHash(seed + 0x51ed270bu)) {}
    uint bits() { return state_ = clvHash(state_ + 0x9e3779b9u); }
    float unit() { return clvUnitFloat(bits()); }
    float signedUnit() { return 2.0f * unit() - 1.0f; }
    int below(int n) { return int(unit() * float(n)); }

private:
    uint state_;
};

enum class RayKind {
    kAnywhere, kAlongAxis, kAlongEdge, kThroughCorners, kFromBoundary, kNextToBoundary, kToBoundary, kFromOutside, kOntoCorner, kPastTheGrid, kBesideTheGrid,
    kTinyComponents, kShort, kEndless, kAlongAxisToBoundary, kCount
};

// In the grid, or up to `margin` of its size around it.
inline vec3 placeAround(Random& random, const ClvVolume& v, float margin) {
    vec3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = v.origin[axis] + v.cellSize * (float(v.resolution[axis]) * (random.unit() * (1.0f + 2.0f * margin) - margin));
    return p;
}
// A corner of the grid's cells.
inline vec3 cellCorner(Random& random, const ClvVolume& v) {
    vec3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = v.origin[axis] + v.cellSize * float(random.below(v.resolution[axis] + 1));
    return p;
}
inline vec3 anyDirection(Random& random) {
    for (;;) {
        const vec3 d(random.signedUnit(), random.signedUnit(), random.signedUnit());
        if (dot(d, d) > 1e-4f) return glm::normalize(d);
    }
}
inline vec3 axisDirection(Random& random) {
    vec3 d(0.0f);
    d[random.below(3)] = random.unit() < 0.5f ? -1.0f : 1.0f;
    return d;
}

inline ClvRay rayOfKind(RayKind kind, Random& random, const ClvVolume& v) {
    ClvRay ray{};
    const float size = v.cellSize * float(std::max({v.resolution.x, v.resolution.y, v.resolution.z}));
    ray.flux = vec3(1.0f);
    ray.origin = placeAround(random, v, 0.0f);
    ray.direction = anyDirection(random);
    ray.maxDistance = size * 2.0f * random.unit();
    switch (kind) {
        case RayKind::kAlongAxis: ray.direction = axisDirection(random); break;
        case RayKind::kAlongEdge: ray.origin = cellCorner(random, v), ray.direction = axisDirection(random); break;
        case RayKind::kThroughCorners: {
            ray.origin = cellCorner(random, v);
            vec3 d(float(random.below(7) - 3), float(random.below(7) - 3), float(random.below(7) - 3));
            if (dot(d, d) == 0.0f) d.x = 1.0f;
            ray.direction = glm::normalize(d);
            break;
        }
        case RayKind::kFromBoundary: {
            const int axis = random.below(3);
            ray.origin[axis] = cellCorner(random, v)[axis];
            break;
        }
        case RayKind::kNextToBoundary: {
            // Off by a few last places of a coordinate, or by more.
            const int axis = random.below(3);
            ray.origin[axis] = cellCorner(random, v)[axis] + random.signedUnit() * v.cellSize * std::ldexp(1.0f, -random.below(24));
            break;
        }
        case RayKind::kToBoundary: {
            const int axis = random.below(3);
            vec3 end = placeAround(random, v, 0.0f);
            end[axis] = cellCorner(random, v)[axis];
            const float length = glm::length(end - ray.origin);
            if (length > 0.0f) ray.direction = (end - ray.origin) / length, ray.maxDistance = length;
            break;
        }
        case RayKind::kFromOutside: ray.origin = placeAround(random, v, 4.0f), ray.maxDistance = 20.0f * size; break;
        case RayKind::kOntoCorner: {
            ray.origin = placeAround(random, v, 4.0f), ray.maxDistance = 20.0f * size;
            const vec3 way = cellCorner(random, v) - ray.origin;
            if (dot(way, way) > 0.0f) ray.direction = glm::normalize(way);
            break;
        }
        case RayKind::kPastTheGrid: {
            const int axis = random.below(3);
            ray.origin[axis] = v.origin[axis] - size * (0.001f + random.unit());
            ray.direction[axis] = -std::abs(ray.direction[axis]);
            break;
        }
        case RayKind::kBesideTheGrid: ray.direction = axisDirection(random), ray.origin = placeAround(random, v, 0.5f); break;
        case RayKind::kTinyComponents: {
            const float tiny[] = {0.0f, -0.0f, 1e-45f, -1e-42f, 1e-38f, -1e-30f, 1e-21f, -1e-19f, 1e-12f, -1e-8f, 3e-7f, -1e-5f};
            ray.direction = axisDirection(random);
            for (int axis = 0; axis < 3; ++axis) {
                if (ray.direction[axis] == 0.0f) ray.direction[axis] = tiny[random.below(12)];
            }
            if (random.unit() < 0.5f) ray.origin = cellCorner(random, v);
            break;
        }
        case RayKind::kShort: {
            const float lengths[] = {0.0f, 1e-45f, 1e-38f, 1e-30f, 1e-20f, 1e-7f, 1e-5f};
            ray.maxDistance = lengths[random.below(7)] * (random.unit() < 0.5f ? 1.0f : v.cellSize);
            if (random.unit() < 0.5f) ray.origin = cellCorner(random, v);
            break;
        }
        case RayKind::kAlongAxisToBoundary: {
            // From a boundary, a corner or anywhere, ending exactly on a boundary wherever floats hold it.
            ray.direction = axisDirection(random);
            if (random.unit() < 0.7f) {
                const vec3 corner = cellCorner(random, v);
                for (int axis = 0; axis < 3; ++axis) {
                    if (ray.direction[axis] != 0.0f || random.unit() < 0.3f) ray.origin[axis] = corner[axis];
                }
            }
            ray.maxDistance = float(random.below(int(size / v.cellSize) + 2)) * v.cellSize;
            break;
        }
        case RayKind::kEndless: ray.maxDistance = random.unit() < 0.5f ? 1e30f : kClvFar; break;
        default: break;
    }
    return ray;
}

}  // namespace clv
