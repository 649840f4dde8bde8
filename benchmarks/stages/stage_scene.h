// A built-in scene with what its stages work on: maps, rays before and after tracing, receivers.
#pragma once
#include <map>
#include <memory>
#include <tuple>

#include "benchmarks/native_tracer.h"
#include "benchmarks/stages/smaller_triangles.h"
#include "bindings/embree/rsm.h"
#include "bindings/embree/task_pool.h"
#include "bindings/embree/visible_points.h"
#include "bindings/scene/builtin_scenes.h"
#include "clv/cpu/build_level.h"
#include "clv/cpu/rays.h"

namespace clv {

struct StageScene {
    static constexpr int kRsmSide = 256;
    static constexpr std::size_t kReceivers = 2000;
    static constexpr std::uint32_t kSeed = 1;

    StageScene(Scene made, std::size_t rayCount) : scene(std::move(made)), embree(scene), bare(scene) {
        const std::size_t each = std::size_t(kRsmSide) * kRsmSide;
        texels.resize(scene.lights.size() * each);
        for (std::size_t k = 0; k < scene.lights.size(); ++k) {
            renderRsm(embree, scene.lights[k].light, kRsmSide, 0, kSeed, serialFor(), std::span(texels).subspan(k * each, each));
        }
        sampler.build(texels, kRsmSide, serialFor());
        rays.resize(rayCount);
        makeRays(sampler, 0, kSeed, embree.surfaceOffset(), rays);
        cut = rays;
        embree.trace(cut);
        receivers = visiblePoints(embree, kReceivers, kSeed);
    }
    StageScene(const StageScene&) = delete;

    ClvVolume grid(int n, std::uint32_t storage) const { return volumeOverBounds(scene.bounds.lo, scene.bounds.hi, n, storage); }
    // Every cell has a slot.
    Level denseLevel(int n, std::uint32_t storage) const {
        BuildOptions options;
        options.findRegions = false;
        return buildLevel(grid(n, storage), embree.probe(), {}, serialFor(), options);
    }
    // The open regions of every cell.
    Level openLevel(int n, std::uint32_t storage) const { return buildLevel(grid(n, storage), embree.probe(), {}, tbbParallelFor()); }

    Scene scene;
    EmbreeScene embree;
    NativeTracer bare;
    std::vector<ClvRsmTexel> texels;
    TexelSampler sampler;
    std::vector<ClvRay> rays, cut;
    std::vector<ClvReceiver> receivers;
};

// Made when it is first asked for, and kept.
inline const StageScene& stageScene(const std::string& name, std::size_t rays, int cuts) {
    static std::map<std::tuple<std::string, std::size_t, int>, std::unique_ptr<StageScene>> scenes;
    auto& scene = scenes[{name, rays, cuts}];
    if (!scene) scene = std::make_unique<StageScene>(withSmallerTriangles(makeBuiltinScene(name), cuts), rays);
    return *scene;
}

}  // namespace clv
