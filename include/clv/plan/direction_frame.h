// The frame in which cells keep directions: the axes that most surfaces face.
//
// An ambient cube is read exactly along its axes. On other normals it confuses the light that a surface sends out with what it
// receives, so the axes belong where most receivers look: square to floors and walls, however the scene is turned.
#ifndef CLV_PLAN_DIRECTION_FRAME_H
#define CLV_PLAN_DIRECTION_FRAME_H
#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "../math/octahedral.h"

namespace clv {
namespace detail {

// Surfaces that face about one direction or its opposite.
struct FacingArea {
    vec3 normal;  // unit length
    float area;   // m^2
};

// `faces` sorted into cells of the octahedral map, opposite normals as one.
inline std::vector<FacingArea> facingAreas(std::span<const vec3> faces) {
    constexpr int kSide = 32;
    std::vector<vec3> sums(std::size_t(kSide) * kSide, vec3(0.0f));
    for (const vec3& face : faces) {
        if (!(dot(face, face) > 0.0f)) continue;
        const vec3 up = face.z < 0.0f || (face.z == 0.0f && (face.y < 0.0f || (face.y == 0.0f && face.x < 0.0f))) ? -face : face;
        const vec2 square = (clvOctahedralFromDirection(up) * 0.5f + 0.5f) * float(kSide);
        const ivec2 bin = clamp(ivec2(floor(square)), ivec2(0), ivec2(kSide - 1));
        sums[std::size_t(bin.x) + std::size_t(kSide) * bin.y] += up;
    }
    std::vector<FacingArea> found;
    for (const vec3& sum : sums) {
        const float area = length(sum);
        if (area > 0.0f) found.push_back({sum / area, area});
    }
    return found;
}

}  // namespace detail

// `faces`: the surfaces' normals, each as long as its area is large, m^2. Row k of the result is axis k, a unit vector, so that
// frame * direction has the components along the axes. The identity where the axes of the grid serve about as well.
inline mat3 directionFrame(std::span<const vec3> faces) {
    constexpr float kAlong = 0.99f, kAcross = 0.14f;  // cosines that count as parallel and as perpendicular: 8 degrees
    constexpr float kLeastGain = 0.05f;               // share of the whole area
    const std::vector<detail::FacingArea> areas = detail::facingAreas(faces);
    float total = 0.0f;
    for (const detail::FacingArea& a : areas) total += a.area;
    auto facing = [&](const vec3& axis) {
        vec3 sum(0.0f);
        for (const detail::FacingArea& a : areas) {
            const float cosine = dot(a.normal, axis);
            if (std::abs(cosine) > kAlong) sum += a.normal * (cosine > 0.0f ? a.area : -a.area);
        }
        return sum;
    };
    // The direction that most area faces, among those that `allowed` lets pass.
    auto mostFaced = [&](auto&& allowed) {
        vec3 best(0.0f);
        for (const detail::FacingArea& a : areas) {
            const vec3 sum = allowed(a.normal) ? facing(a.normal) : vec3(0.0f);
            if (dot(sum, sum) > dot(best, best)) best = sum;
        }
        return best;
    };
    const vec3 first = mostFaced([](const vec3&) { return true; });
    if (!(dot(first, first) > 0.0f)) return mat3(1.0f);
    std::array<vec3, 3> axes;
    axes[0] = normalize(first);
    vec3 second = mostFaced([&](const vec3& n) { return std::abs(dot(n, axes[0])) < kAcross; });
    second -= axes[0] * dot(axes[0], second);
    if (!(dot(second, second) > 0.0f)) return mat3(1.0f);
    axes[1] = normalize(second);
    axes[2] = cross(axes[0], axes[1]);

    float along = 0.0f, grid = 0.0f;
    for (int axis = 0; axis < 3; ++axis) along += length(facing(axes[axis])), grid += length(facing(mat3(1.0f)[axis]));
    if (along - grid < kLeastGain * total) return mat3(1.0f);
    return glm::transpose(mat3(axes[0], axes[1], axes[2]));
}

}  // namespace clv
#endif
