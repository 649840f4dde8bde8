// Levels and rays for tests of what happens in cells.
#ifndef CLV_TESTS_VULKAN_LEVEL_SCENE_H
#define CLV_TESTS_VULKAN_LEVEL_SCENE_H
#include <limits>
#include <string>

#include "bindings/embree/embree_scene.h"
#include "bindings/scene/builtin_scenes.h"
#include "bindings/vulkan/vulkan_level.h"
#include "clv/cpu/build_level.h"
#include "clv/math/sampling.h"
#include "clv/math/sobol.h"

namespace clv::test {

// Two rooms in about n^3 cells, some of them cut by walls.
inline Level twoRoomsLevel(const EmbreeScene& scene, int n) {
    const auto& bounds = scene.scene().bounds;
    return buildLevel(volumeOverBounds(bounds.lo, bounds.hi, n, kClvStorageCube9, vec3(0.3f, 0.6f, 0.1f)), scene.probe(), {}, serialFor());
}

// Cells without geometry; odd numbers of them, and a scrolled table.
inline Level openLevel() {
    ClvVolume volume{};
    volume.origin = vec3(-1.0f, 0.5f, 2.0f), volume.cellSize = 0.25f;
    volume.resolution = ivec3(7, 5, 9), volume.scroll = ivec3(3, 1, 8);
    BuildOptions options;
    options.findRegions = false;
    return buildLevel(volume, {}, {}, serialFor(), options);
}

// Rays of all kinds: inside and through the level, along its axes, on its cells' faces, and such as add nothing. `count` is even.
inline std::vector<ClvRay> testRays(const ClvVolume& volume, std::size_t count) {
    const vec3 size = vec3(volume.resolution) * volume.cellSize;
    std::vector<ClvRay> rays;
    for (std::uint32_t i = 0; rays.size() < count; ++i) {
        const vec4 u = clvSobol4(i, 1), v = clvSobol4(i, 2);
        ClvRay ray{};
        ray.origin = volume.origin + size * vec3(u);
        ray.maxDistance = size.x * u.w;
        ray.direction = clvSphereFromSquare(vec2(v.x, v.y));
        ray.flux = vec3(0.5f + v.z, 1.0f, 0.5f + v.w);
        vec3 axis(0.0f);
        axis[int(i / 16 % 3)] = i % 2 ? 1.0f : -1.0f;
        const vec3 face = volume.origin + floor((ray.origin - volume.origin) / volume.cellSize) * volume.cellSize;
        switch (i % 16) {
            case 0: ray.origin -= ray.direction * (2.0f * length(size)), ray.maxDistance = kClvFar; break;  // from outside, through all
            case 1: ray.origin += vec3(10.0f) * size; break;                                                // far outside
            case 2: ray.maxDistance = 0.0f; break;                                                          // dead
            case 3: ray.direction = axis; break;
            case 4: ray.direction = axis, ray.origin = face; break;                                         // along the edges of cells
            case 5: ray.origin = face; break;                                                               // from a corner
            case 6: ray.direction = normalize(vec3(1.0f, u.x < 0.5f ? 1.0f : -1.0f, 0.0f)), ray.origin = face; break;  // from edge to edge
            case 7: ray.maxDistance = 1e-30f; break;
            case 8: if (i % 64 == 8) ray.flux.y = std::numeric_limits<float>::quiet_NaN(); break;
            case 9: if (i % 64 == 9) ray.direction.z = std::numeric_limits<float>::infinity(); break;
            default: break;
        }
        rays.push_back(ray);
    }
    return rays;
}

}  // namespace clv::test
#endif
