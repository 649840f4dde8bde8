#include "bindings/embree/light_check.h"

#include <algorithm>

#include "bindings/embree/seen_faces.h"
#include "bindings/scene/scene_facts.h"
#include "clv/stages/rsm.h"

namespace clv {
namespace {

constexpr uint kSide = 16;  // of a light's map

struct Met {
    double fronts = 0.0, backs = 0.0;  // W, all channels together
    float reach = kClvFar;             // see LightCheck
};

Met whatIsMet(const EmbreeScene& embree, const ClvLight& light) {
    const Scene& scene = embree.scene();
    std::vector<ClvRay> rays;
    for (uint k = 0; k < kSide * kSide; ++k) {
        const vec2 u = clvRsmSamplePoint(uvec2(k % kSide, k / kSide), kSide, 0, 1);
        rays.push_back(clvLightRay(light, u, scene.bounds.lo, scene.bounds.hi));
    }
    std::vector<ClvHit> hits(rays.size());
    embree.trace(rays, hits);
    Met met;
    for (std::size_t k = 0; k < rays.size(); ++k) {
        if (hits[k].primitive == kClvNoPrimitive) continue;
        const vec3 flux = rays[k].flux * (1.0f / float(kSide * kSide));
        (dot(windingNormal(scene, hits[k].primitive), rays[k].direction) < 0.0f ? met.fronts : met.backs) += double(flux.x) + double(flux.y) + double(flux.z);
    }
    if (light.type != kClvLightDirectional) {
        std::vector<float> distances;
        for (std::size_t k = 0; k < rays.size(); ++k) distances.push_back(hits[k].primitive == kClvNoPrimitive ? kClvFar : distance(rays[k].origin + rays[k].direction * hits[k].distance, light.position));
        const auto quarter = distances.begin() + std::ptrdiff_t(distances.size() / 4);
        std::nth_element(distances.begin(), quarter, distances.end());
        met.reach = *quarter;
    }
    return met;
}

}  // namespace

LightCheck checkLights(const EmbreeScene& embree, const ParallelFor& parallelFor) {
    const std::vector<NamedLight>& lights = embree.scene().lights;
    std::vector<Met> met(lights.size());
    parallelFor(lights.size(), [&](std::size_t k) {
        if (sendsLight(lights[k])) met[k] = whatIsMet(embree, lights[k].light);
    });
    LightCheck check;
    Met sum;
    for (std::size_t k = 0; k < lights.size(); ++k) {
        if (sendsLight(lights[k]) && !(met[k].fronts + met[k].backs > 0.0)) check.idle.push_back(lights[k].name);
        sum.fronts += met[k].fronts, sum.backs += met[k].backs;
    }
    const double all = sum.fronts + sum.backs;
    if (sum.backs > 0.0) check.shareOnBacks = sum.backs / all;
    for (const Met& one : met) check.reach.push_back(one.reach);
    for (const Met& one : met) check.shares.push_back(all > 0.0 ? (one.fronts + one.backs) / all : 0.0);
    return check;
}

void turnFaces(Scene& scene) {
    for (glm::uvec3& triangle : scene.triangles) std::swap(triangle.y, triangle.z);
}

}  // namespace clv
