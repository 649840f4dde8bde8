// What an acceleration structure is built from: see FrameBinding::corners.
#ifndef CLV_PLAN_TRIANGLE_CORNERS_H
#define CLV_PLAN_TRIANGLE_CORNERS_H
#include <algorithm>
#include <span>
#include <vector>

#include "../data/bvh.h"
#include "frame.h"

namespace clv {

// Three corners (m) for each of `count` triangles in the rows of data/bvh.h, in their order; `count` is at least theirs, and the
// triangles that are not there are points, which no ray meets.
inline std::vector<vec3> triangleCorners(std::span<const vec4> rows, std::size_t count) {
    static_assert(3 * sizeof(vec3) == kFrameCornerBytes);
    std::vector<vec3> corners;
    for (std::size_t row = 0; row + kClvTriangleRows <= rows.size(); row += kClvTriangleRows) {
        const vec3 first(rows[row]);
        corners.insert(corners.end(), {first, first + vec3(rows[row + 1]), first + vec3(rows[row + 2])});
    }
    corners.resize(std::max(corners.size(), 3 * count), corners.empty() ? vec3(0.0f) : corners.front());
    return corners;
}

}  // namespace clv
#endif
