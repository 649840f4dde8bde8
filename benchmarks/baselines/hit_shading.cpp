#include "benchmarks/baselines/hit_shading.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "bindings/embree/direct_light.h"

namespace clv {

std::size_t traceAndShade(const EmbreeScene& scene, std::span<ClvRay> rays, std::span<ClvHit> hits, std::span<glm::vec3> radiance) {
    assert(rays.size() <= kShadedRays && hits.size() == rays.size() && radiance.size() == rays.size());
    scene.traceFast(rays, hits);
    std::fill(radiance.begin(), radiance.end(), glm::vec3(0.0f));
    std::size_t traced = rays.size();
    std::array<ClvRay, kShadedRays> shadows;  // flux: what their light adds to the radiance
    std::array<std::size_t, kShadedRays> owner;
    for (const NamedLight& light : scene.scene().lights) {
        std::size_t asked = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (hits[i].primitive == kClvNoPrimitive) continue;
            const glm::vec3 position = rays[i].origin + rays[i].direction * hits[i].distance;
            const DirectLight arriving = directLightAt(light.light, position);
            const float cosine = glm::dot(arriving.towardsLight, hits[i].normal);
            const glm::vec3 reflected = hits[i].albedo * arriving.irradiance * (cosine * kClvInvPi);
            if (!(cosine > 0.0f) || reflected == glm::vec3(0.0f)) continue;
            owner[asked] = i;
            shadows[asked] = shadowRay(light.light, position + hits[i].normal * scene.surfaceOffset(), scene.surfaceOffset());
            shadows[asked++].flux = reflected;
        }
        scene.killOccludedFast(std::span(shadows).first(asked));
        for (std::size_t k = 0; k < asked; ++k) {
            if (shadows[k].maxDistance > 0.0f) radiance[owner[k]] += shadows[k].flux;
        }
        traced += asked;
    }
    return traced;
}

}  // namespace clv
