// Built-in scenes with the light of a few rays, as volumes on disk.
#pragma once
#include <string>

#include "bindings/embree/embree_scene.h"
#include "bindings/embree/light_maps.h"
#include "bindings/embree/task_pool.h"
#include "bindings/volume_file/volume_file.h"
#include "clv/cpu/build_level.h"
#include "clv/cpu/still_lighting.h"
#include "viz/live_light.h"

namespace clv::test {

constexpr std::size_t kRays = 64 << 10;

// About resolution^3 cells over the whole scene, one bounce, two estimates. With one part a half, the light is the same on every machine.
inline BakedVolume bakedScene(const std::string& name, int resolution) {
    const Scene scene = loadScene(name);
    const EmbreeScene embree(scene);
    const ParallelFor parallelFor = tbbParallelFor();
    BakedVolume volume;
    volume.scene = name;
    volume.libraryVersion = "0.1.0";
    volume.mark = markOf(scene);
    volume.anchor = scene.anchor;
    volume.lights = scene.lights;
    volume.camera = scene.cameras.front();
    const ClvVolume grid = volumeOverBounds(scene.bounds.lo, scene.bounds.hi, resolution, volume.layout.storage, vec3(0.3f, 0.2f, 0.4f));
    StillLighting lighting({.layout = volume.layout, .parts = {.halves = 2, .chunks = 1}, .originOffset = embree.surfaceOffset()},
                           [&](std::span<ClvRay> rays) { embree.trace(rays); }, parallelFor);
    const Volume& lit = lighting.addLevel(buildLevel(grid, embree.probe(), {}, parallelFor));
    LightMaps maps(embree, 1, parallelFor);
    TexelSampler sampler;
    sampler.build(maps.render(0), maps.side(), parallelFor);
    lighting.rays(sampler, kRays);
    lighting.trace();
    lighting.inject();
    lighting.merge();
    BakedCascade& cascade = volume.cascades.emplace_back();
    cascade.level = lit.level();
    for (int half = 0; half < 2; ++half) cascade.estimates.emplace_back(lit.history(half).begin(), lit.history(half).end());
    cascade.samples.assign(cascade.level.slots.size(), float(lit.rays()));
    return volume;
}

// The light of a few frames in which the scene's first lamp moves along x, with dynamicity.
inline BakedVolume movedScene(const std::string& name, int resolution) {
    BakedVolume volume = bakedScene(name, 4);
    World world(volume, "");
    const ParallelFor parallelFor = tbbParallelFor();
    LiveLight live(world, {.resolution = resolution, .rays = kRays / 4}, *volume.camera, parallelFor);
    for (int frame = 0; frame < 4; ++frame) {
        std::vector<NamedLight> lights = world.scene().lights;
        lights[0].light.position.x += 0.02f;
        lights[0].light.dynamicity = 1.0f;
        world.setLights(lights);
        live.frame(1.0f / 30.0f, *volume.camera, volume);
    }
    return volume;
}

}  // namespace clv::test
