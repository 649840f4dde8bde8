#include "bindings/embree/light_check.h"

#include <algorithm>
#include <utility>

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

double total(const vec3& flux) { return double(flux.x) + double(flux.y) + double(flux.z); }

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
        (dot(windingNormal(scene, hits[k].primitive), rays[k].direction) < 0.0f ? met.fronts : met.backs) += total(rays[k].flux * (1.0f / float(kSide * kSide)));
    }
    if (light.type != kClvLightDirectional) {
        std::vector<std::pair<float, double>> sent;  // how far, m, and how much, W
        double sum = 0.0;
        for (std::size_t k = 0; k < rays.size(); ++k) {
            const vec3 end = rays[k].origin + rays[k].direction * hits[k].distance;
            sent.emplace_back(hits[k].primitive == kClvNoPrimitive ? kClvFar : distance(end, light.position), total(rays[k].flux));
            sum += sent.back().second;
        }
        std::ranges::sort(sent);
        double within = 0.0;
        for (const auto& [far, flux] : sent) {
            if ((within += flux) < 0.25 * sum) continue;
            met.reach = far;
            break;
        }
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
    for (const Met& one : met) {
        check.shares.push_back(all > 0.0 ? (one.fronts + one.backs) / all : 0.0);
        check.reach.push_back(one.reach);
    }
    return check;
}

void turnFaces(Scene& scene) {
    for (glm::uvec3& triangle : scene.triangles) std::swap(triangle.y, triangle.z);
}

}  // namespace clv
