#include "viz/world.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "bindings/embree/light_maps.h"
#include "clv/cpu/rays.h"

namespace clv {
namespace {

constexpr float kSameBounds = 1e-4f;  // of the scene's size: what another program may round them by

Scene sceneOf(const BakedVolume& volume, const std::string& file) {
    const std::string& name = file.empty() ? volume.scene : file;
    Scene scene = loadScene(name);
    if (scene.anchor != volume.anchor)
        throw InputError(fmt::format("{}: expected the scene of the volume, but its anchor lies {} m away", name, glm::length(scene.anchor - volume.anchor)));
    if (volume.mark) {
        const SceneMark mark = markOf(scene);
        if (mark.triangles != volume.mark->triangles)
            throw InputError(fmt::format("{}: expected the scene of the volume, {}, with {} triangles, found {}", name, volume.scene, volume.mark->triangles, mark.triangles));
        const float off = glm::length(mark.bounds.lo - volume.mark->bounds.lo) + glm::length(mark.bounds.hi - volume.mark->bounds.hi);
        if (!(off <= kSameBounds * glm::length(mark.bounds.extent())))
            throw InputError(fmt::format("{}: expected the scene of the volume, {}, but its bounds are others, {} m off", name, volume.scene, off));
    }
    scene.lights = volume.lights;
    return scene;
}

// m, from a position inside the bounds to where a ray leaves them.
float distanceToBounds(const Bounds& bounds, const ClvRay& ray) {
    float nearest = kClvFar;
    for (int axis = 0; axis < 3; ++axis) {
        if (ray.direction[axis] == 0.0f) continue;
        const float side = ray.direction[axis] > 0.0f ? bounds.hi[axis] : bounds.lo[axis];
        nearest = std::min(nearest, std::max(0.0f, (side - ray.origin[axis]) / ray.direction[axis]));
    }
    return nearest;
}

}  // namespace

World::World(const BakedVolume& volume, const std::string& file) : scene_(sceneOf(volume, file)), embree_(scene_) {}

void World::setLights(const std::vector<NamedLight>& lights) {
    const auto same = [](const NamedLight& a, const NamedLight& b) { return std::memcmp(&a.light, &b.light, sizeof(ClvLight)) == 0; };
    if (!std::ranges::equal(scene_.lights, lights, same)) truth_.clear();
    scene_.lights = lights;
}

std::vector<ClvRsmTexel> World::texels(const ParallelFor& parallelFor) const {
    LightMaps maps(embree_, 1, parallelFor);
    std::vector<ClvRsmTexel> lit;
    std::ranges::copy_if(maps.render(0), std::back_inserter(lit), [](const ClvRsmTexel& texel) { return texel.valid != 0u; });
    return lit;
}

std::vector<ClvRay> World::rays(std::size_t count, std::uint32_t seed, const ParallelFor& parallelFor) const {
    LightMaps maps(embree_, seed, parallelFor);
    TexelSampler sampler;
    sampler.build(maps.render(0), maps.side(), parallelFor);
    std::vector<ClvRay> rays(count);
    makeRays(sampler, 0, seed, embree_.surfaceOffset(), rays);
    embree_.trace(rays);
    std::erase_if(rays, [](const ClvRay& ray) { return !(ray.maxDistance > 0.0f); });
    for (ClvRay& ray : rays) ray.maxDistance = std::min(ray.maxDistance, distanceToBounds(scene_.bounds, ray));
    return rays;
}

}  // namespace clv
