// The pictures that a light's reflective shadow map is drawn in.
#ifndef CLV_PLAN_MAP_FACES_H
#define CLV_PLAN_MAP_FACES_H
#include <span>
#include <vector>

#include "../stages/map_face.h"
#include "../stages/rsm.h"

namespace clv {

// Cones up to this half angle, rad, take one picture: in a wider one, texels in the middle would cover several times those at the rim.
inline constexpr float kWidestFace = 1.0f;
// Nothing nearer to a light than this share of the scene's diagonal is drawn.
inline constexpr float kNearestShare = 1e-5f;

namespace detail {

// Half a width from the middle is where the rim begins.
inline ClvMapFace makeFace(uint light, uint side, const vec3& origin, const vec3& forward, const vec3& right, const vec3& up, float halfWidth, float halfHeight) {
    const float inner = 1.0f - 2.0f * kClvFaceRim / float(side);
    ClvMapFace face{};
    face.origin = origin, face.light = light, face.forward = forward;
    face.right = right * (inner / halfWidth), face.up = up * (inner / halfHeight);
    return face;
}

inline void addSpreadingFace(std::vector<ClvMapFace>& faces, uint light, uint side, const vec3& origin, const vec3& forward, const vec3& right, const vec3& up, float tangent, float nearest) {
    faces.push_back(makeFace(light, side, origin, forward, right, up, tangent, tangent));
    faces.back().depthScale = nearest;
}

}  // namespace detail

// In the order of the lights. [lo, hi]: the scene's bounds, m; side: texels along a side of a picture, > 4.
inline std::vector<ClvMapFace> mapFaces(std::span<const ClvLight> lights, const vec3& lo, const vec3& hi, uint side) {
    std::vector<ClvMapFace> faces;
    const float nearest = std::max(kNearestShare * length(hi - lo), 1e-30f);
    for (uint k = 0; k < lights.size(); ++k) {
        const ClvLight& light = lights[k];
        const bool isPoint = light.type == kClvLightPoint;
        const vec3 forward = isPoint ? vec3(0, 0, 1) : light.direction;
        vec3 right, up;
        clvBasis(forward, right, up);
        if (light.type == kClvLightDirectional) {
            const vec3 start = clvDirectionalLightRay(light, vec2(0.5f), lo, hi).origin;
            const float width = std::max(clvHalfExtentAlong(right, lo, hi), nearest), height = std::max(clvHalfExtentAlong(up, lo, hi), nearest);
            faces.push_back(detail::makeFace(k, side, start, forward, right, up, width, height));
            faces.back().parallel = 1;
            faces.back().depthScale = 0.5f / dot(0.5f * (lo + hi) - start, forward);
        } else if (!isPoint && light.outerConeAngle <= kWidestFace) {
            detail::addSpreadingFace(faces, k, side, light.position, forward, right, up, std::tan(light.outerConeAngle), nearest);
        } else {
            // A cube's faces; what lies behind a spot light is dark.
            detail::addSpreadingFace(faces, k, side, light.position, forward, right, up, 1.0f, nearest);
            detail::addSpreadingFace(faces, k, side, light.position, right, up, forward, 1.0f, nearest);
            detail::addSpreadingFace(faces, k, side, light.position, -right, up, forward, 1.0f, nearest);
            detail::addSpreadingFace(faces, k, side, light.position, up, forward, right, 1.0f, nearest);
            detail::addSpreadingFace(faces, k, side, light.position, -up, forward, right, 1.0f, nearest);
            if (isPoint) detail::addSpreadingFace(faces, k, side, light.position, -forward, up, right, 1.0f, nearest);
        }
    }
    return faces;
}

// What a camera sees of a picture. forward, up: unit length, orthogonal; yfov: rad, the whole vertical angle; aspect: width / height;
// nearest: m, > 0.
inline ClvMapFace cameraFace(const vec3& position, const vec3& forward, const vec3& up, float yfov, float aspect, float nearest) {
    const float tangent = std::tan(0.5f * yfov);
    ClvMapFace face{};
    face.origin = position, face.forward = forward, face.depthScale = nearest;
    face.right = cross(forward, up) / (tangent * aspect), face.up = up / tangent;
    return face;
}

}  // namespace clv
#endif
