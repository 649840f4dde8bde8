// How much of a ray lies in a grid, in double precision: what the pieces of its walk must add up to.
#pragma once
#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

#include "bindings/cli/stress/stress_case.h"
#include "clv/data/light_volume.h"
#include "clv/data/ray.h"

namespace clv {

// A ray in double precision, in cells from the grid's lowest corner, and how finely floats tell places in it.
struct ExactRay {
    glm::dvec3 origin, direction;
    double length;
    double place;  // the last place of the largest coordinate that the walk computes with, in cells
};
inline ExactRay exactRay(const ClvVolume& v, const ClvRay& ray) {
    ExactRay exact;
    exact.origin = (glm::dvec3(ray.origin) - glm::dvec3(v.origin)) / double(v.cellSize);
    exact.direction = glm::dvec3(ray.direction);
    exact.length = double(ray.maxDistance) / double(v.cellSize);
    double largest = 0.0;
    for (int axis = 0; axis < 3; ++axis) largest = std::max({largest, double(v.resolution[axis]), std::abs(exact.origin[axis])});
    exact.place = 0x1p-23 * largest;
    return exact;
}

// How far a place along a ray lies outside of a cell, in cells; below 0 inside.
inline double cellsOutside(const ExactRay& ray, const ivec3& cell, double t) {
    const glm::dvec3 above = ray.origin + ray.direction * t - glm::dvec3(cell);
    double outside = -1.0;
    for (int axis = 0; axis < 3; ++axis) outside = largerOf(outside, std::max(-above[axis], above[axis] - 1.0));
    return outside;
}

// The part of a ray inside the grid made wider by `margin` cells on all sides.
struct Interval {
    double begin = 0.0, end = 0.0;
    double length() const { return std::max(0.0, end - begin); }
};
inline Interval clip(const ClvVolume& v, const ExactRay& ray, double margin) {
    Interval inside{0.0, ray.length};
    for (int axis = 0; axis < 3; ++axis) {
        const double lo = -margin - ray.origin[axis], hi = v.resolution[axis] + margin - ray.origin[axis], d = ray.direction[axis];
        if (d == 0.0) {
            if (lo > 0.0 || hi < 0.0) return {};
            continue;
        }
        inside.begin = std::max(inside.begin, std::min(lo / d, hi / d));
        inside.end = std::min(inside.end, std::max(lo / d, hi / d));
    }
    return inside;
}

// Length of a ray inside the grid, in cells. The grid's faces are uncertain by the rounding of the ray's origin to whole cells and a fraction, two
// last places: a ray that runs in a face of the grid may count as inside or as outside.
struct ClippedLength {
    double least = 0.0, most = 0.0;
    double place = 0.0;  // of the largest coordinate or distance
    // How far a length lies outside of [least, most].
    double excess(double length) const { return largerOf(0.0, largerOf(least - length, length - most)); }
};
inline ClippedLength clippedLength(const ClvVolume& v, const ExactRay& ray) {
    const double rounding = 2.0 * ray.place;
    const Interval wide = clip(v, ray, rounding);
    return {clip(v, ray, -rounding).length(), wide.length(), std::max(ray.place, 0x1p-23 * wide.end)};
}

}  // namespace clv
