// Inject: a cut ray is written into every cell that it crosses, in proportion to its length there.
//
// A ray of flux P that travels l metres along d inside a cell adds P f_k(d) l to coefficient k of the cell. The sum over rays,
// over the open volume, is an unbiased estimate of the cell's mean coefficient (the track-length estimator of neutron transport,
// Spanier and Gelbard 1969). The cells in which a ray starts and ends both count.
#ifndef CLV_STAGES_INJECT_H
#define CLV_STAGES_INJECT_H
#include "../data/cell.h"
#include "../data/light_volume.h"
#include "../data/ray.h"
#include "../math/finite.h"
CLV_NAMESPACE_BEGIN

// The track-length estimator, or the rule of Brattén and Lindén (2013, section 3.4): each crossed cell but the first gets
// max(0, -d n), whatever the length.
CLV_CONST uint kClvInjectTrackLength = 0u;
CLV_CONST uint kClvInjectThesis = 1u;

// Direction components below this count as parallel to the axis, so that their reciprocal stays finite.
CLV_CONST float kClvParallel = 1e-20f;
// Plane crossing of an axis that the ray runs parallel to, in cells: never reached.
CLV_CONST float kClvNever = 1e30f;

// A ray on its way through a grid. Distances are in cells. Boundaries are integers, and the distance to one is computed afresh
// from it, so errors do not add up and the walk cannot leave the grid.
struct ClvWalk {
    vec3 origin;     // in cells, from the volume's lowest corner
    float t;         // where the current cell was entered
    vec3 inverse;    // 1 / direction
    float tEnd;      // where the ray ends or leaves the grid
    vec3 boundary;   // coordinate of the next boundary, an axis each
    float first;     // 1 in the cell that holds the ray's start, else 0
    ivec3 cell;
    int running;     // 0: the walk is over
};

struct ClvCrossing {
    ivec3 cell;
    float tBegin;    // in cells along the ray
    float tEnd;
    int isStart;     // 1: the ray starts in this cell
};

CLV_FN float clvWalkInverse(float direction) { return abs(direction) > kClvParallel ? 1.0f / direction : 1.0f; }

// An axis' interval inside [0, size]; a parallel ray outside of it gets an empty one.
CLV_FN vec2 clvWalkSlab(float origin, float direction, float inverse, float size) {
    if (!(abs(direction) > kClvParallel)) {
        return origin >= 0.0f && origin <= size ? vec2(-kClvNever, kClvNever) : vec2(kClvNever, -kClvNever);
    }
    float a = (0.0f - origin) * inverse;
    float b = (size - origin) * inverse;
    return vec2(min(a, b), max(a, b));
}

CLV_FN float clvWalkFirstBoundary(float direction, int cell) {
    if (!(abs(direction) > kClvParallel)) return kClvNever;
    return float(direction > 0.0f ? cell + 1 : cell);
}

// Begins the walk of a ray; one that misses the grid, is dead or not finite gives a walk that is over. Its length may be endless.
CLV_FN ClvWalk clvWalkBegin(ClvVolume volume, ClvRay ray) {
    ClvWalk walk;
    float scale = 1.0f / volume.cellSize;
    walk.origin = (ray.origin - volume.origin) * scale;
    walk.inverse = vec3(clvWalkInverse(ray.direction.x), clvWalkInverse(ray.direction.y), clvWalkInverse(ray.direction.z));
    vec2 x = clvWalkSlab(walk.origin.x, ray.direction.x, walk.inverse.x, float(volume.resolution.x));
    vec2 y = clvWalkSlab(walk.origin.y, ray.direction.y, walk.inverse.y, float(volume.resolution.y));
    vec2 z = clvWalkSlab(walk.origin.z, ray.direction.z, walk.inverse.z, float(volume.resolution.z));
    float tBegin = max(max(x.x, y.x), max(z.x, 0.0f));
    walk.tEnd = min(min(x.y, y.y), min(z.y, ray.maxDistance * scale));
    walk.t = tBegin;
    vec3 p = floor(walk.origin + ray.direction * tBegin);
    vec3 last = vec3(float(volume.resolution.x - 1), float(volume.resolution.y - 1), float(volume.resolution.z - 1));
    p = min(max(vec3(0.0f, 0.0f, 0.0f), p), last);  // in this order NaN becomes 0
    walk.cell = ivec3(int(p.x), int(p.y), int(p.z));
    walk.boundary = vec3(clvWalkFirstBoundary(ray.direction.x, walk.cell.x), clvWalkFirstBoundary(ray.direction.y, walk.cell.y),
                         clvWalkFirstBoundary(ray.direction.z, walk.cell.z));
    walk.first = tBegin == 0.0f ? 1.0f : 0.0f;
    bool finite = clvIsFinite(walk.origin) && clvIsFinite(ray.direction);
    walk.running = finite && ray.maxDistance > 0.0f && walk.tEnd > tBegin ? 1 : 0;
    return walk;
}

// The current cell's crossing; then moves on to the next cell. Call it while walk.running is 1.
CLV_FN ClvCrossing clvWalkStep(CLV_INOUT(ClvWalk) walk, vec3 direction) {
    vec3 next = (walk.boundary - walk.origin) * walk.inverse;
    float nearest = min(min(next.x, next.y), next.z);
    ClvCrossing crossing;
    crossing.cell = walk.cell;
    crossing.tBegin = walk.t;
    // Rounding can put the first boundary behind the entry point: the piece is then empty, never negative.
    crossing.tEnd = max(min(nearest, walk.tEnd), walk.t);
    crossing.isStart = walk.first > 0.0f ? 1 : 0;
    walk.first = 0.0f;
    walk.t = crossing.tEnd;
    if (nearest >= walk.tEnd) {
        walk.running = 0;
        return crossing;
    }
    if (next.x == nearest) {
        walk.cell.x += direction.x > 0.0f ? 1 : -1;
        walk.boundary.x += direction.x > 0.0f ? 1.0f : -1.0f;
    } else if (next.y == nearest) {
        walk.cell.y += direction.y > 0.0f ? 1 : -1;
        walk.boundary.y += direction.y > 0.0f ? 1.0f : -1.0f;
    } else {
        walk.cell.z += direction.z > 0.0f ? 1 : -1;
        walk.boundary.z += direction.z > 0.0f ? 1.0f : -1.0f;
    }
    return crossing;
}

// Weight of a crossing, m: its length, or the thesis' 0 or 1.
CLV_FN float clvCrossingWeight(uint rule, ClvCrossing crossing, float cellSize) {
    if (rule == kClvInjectThesis) return crossing.isStart == 1 ? 0.0f : 1.0f;
    return (crossing.tEnd - crossing.tBegin) * cellSize;
}

// Deposits as integers: the nearest to value * scale, which must lie within the integers; see clvFixedScale.
CLV_FN int clvFixedFromFloat(float value, float scale) { return int(floor(value * scale + 0.5f)); }

// The most by which a ray of unit flux adds to any coefficient of a slot. Along a cell's side the product of direction and length is at
// most that side, and no other function of a storage gets above it; along an axis that is turned it may be the cell's diagonal.
CLV_FN float clvLargestDeposit(uint rule, uint turned, float cellSize) {
    if (rule == kClvInjectThesis) return 1.0f;
    return turned == 0u ? cellSize : 1.7320509f * cellSize;
}

// The most that a ray may add to a coefficient of a slot, W m. A float that numbers of at most this size are added to stops at 2^25 times it,
// however many they are; the sum of 2^12 such floats is still finite.
CLV_CONST float kClvMostDeposit = 1.2379400e27f;  // 2^90

// Flux that a channel of a ray carries into a level at most, W: what it has beyond that is cut off, so that no sum is ever infinite.
CLV_FN float clvMostFlux(uint rule, float cellSize) { return kClvMostDeposit / clvLargestDeposit(rule, 1u, cellSize); }

// The largest scale, 1/(W m), with which no sum of the deposits of `rays` rays can overflow, whatever they do: each adds at most
// largestFlux (W, of any channel of any ray) times largestDeposit, and half a unit of rounding.
CLV_FN float clvFixedScale(float largestFlux, uint rays, float largestDeposit) {
    // The largest float below 2^31; a thousandth is left for lengths that were rounded up.
    float room = (2147483520.0f - 0.5f * float(rays)) * 0.999f;
    return room / max(min(largestFlux * largestDeposit, kClvMostDeposit) * float(rays), 1.0e-27f);
}

CLV_NAMESPACE_END
#endif
