#include "bindings/embree/seen_faces.h"

#include "clv/math/sampling.h"
#include "clv/math/sobol.h"

namespace clv {

SeenFaces seenFaces(const EmbreeScene& scene, const ClvReceiver& receiver, std::uint32_t seed,
                    const std::function<void(const glm::vec3& position, const ClvHit& hit)>& onHit) {
    SeenFaces seen;
    const glm::vec3 origin = receiver.position + receiver.normal * scene.surfaceOffset();
    for (uint k = 0; k < uint(kSeenRays); ++k) {
        const vec4 u = clvSobol4(k, seed);
        const vec3 direction = clvCosineFromSquare(vec2(u.x, u.y), receiver.normal);
        const ClvHit hit = scene.hit(origin, direction, kClvFar);
        if (hit.primitive == kClvNoPrimitive) continue;
        (dot(windingNormal(scene.scene(), hit.primitive), direction) < 0.0f ? seen.fronts : seen.backs)++;
        if (onHit) onHit(origin + direction * hit.distance, hit);
    }
    return seen;
}

glm::vec3 windingNormal(const Scene& scene, std::uint32_t triangle) {
    const glm::uvec3& c = scene.triangles[triangle];
    return cross(scene.positions[c.y] - scene.positions[c.x], scene.positions[c.z] - scene.positions[c.x]);
}

}  // namespace clv
