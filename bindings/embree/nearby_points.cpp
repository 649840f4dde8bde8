#include "bindings/embree/nearby_points.h"

#include <cmath>

#include "clv/math/sampling.h"
#include "clv/math/sobol.h"

namespace clv {

std::vector<ClvReceiver> nearbyPoints(const EmbreeScene& scene, std::span<const ClvReceiver> points, float radius, std::size_t count, std::uint32_t seed) {
    constexpr float kLeastCosine = 0.77f;  // of 40 degrees
    std::vector<ClvReceiver> nearby;
    if (points.empty()) return nearby;
    nearby.reserve(count);
    const std::size_t tries = 4 * count;
    for (std::size_t i = 0; i < tries && nearby.size() < count; ++i) {
        const ClvReceiver& point = points[i % points.size()];
        const vec4 u = clvSobol4(uint(i / points.size()), clvHashCombine(seed, uint(i % points.size())));
        const vec2 disk = clvDiskFromSquare(vec2(u.x, u.y)) * radius;
        vec3 tangent, bitangent;
        clvBasis(point.normal, tangent, bitangent);
        const vec3 step = tangent * disk.x + bitangent * disk.y;
        const float length = glm::length(step), height = 0.25f * radius;
        if (!(length > 0.0f) || scene.occluded(point.position + point.normal * scene.surfaceOffset(), step / length, length)) continue;
        const vec3 above = point.position + step + point.normal * height;
        const ClvHit hit = scene.hit(above, -point.normal, 2.0f * height);
        if (hit.primitive == kClvNoPrimitive || dot(hit.normal, point.normal) < kLeastCosine) continue;
        nearby.push_back({above - point.normal * hit.distance, 0.0f, hit.normal, 0.0f});
    }
    return nearby;
}

}  // namespace clv
