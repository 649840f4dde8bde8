#include "bindings/cli/bake_light.h"

#include <algorithm>
#include <functional>
#include <optional>

#include "bindings/cli/first_bounce.h"
#include "bindings/cli/further_bounces.h"

namespace clv {
namespace {

// Deposits of the levels on top of those of the cascades. A level with one estimate adds it to both.
void addDeposits(std::span<const LitLevel> levels, std::vector<BakedCascade>& cascades) {
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const auto halves = levels[i].light->histories();
        for (std::size_t half = 0; half < cascades[i].estimates.size(); ++half) {
            const std::span<const float> from = halves[std::min(half, halves.size() - 1)];
            std::ranges::transform(cascades[i].estimates[half], from, cascades[i].estimates[half].begin(), std::plus<float>());
        }
    }
}

std::vector<BakedCascade> cascadesFrom(std::span<const LitLevel> levels) {
    std::vector<BakedCascade> cascades;
    for (const LitLevel& lit : levels) {
        const auto halves = lit.light->histories();
        BakedCascade& cascade = cascades.emplace_back(BakedCascade{lit.light->level(), {}, {}, {}});
        cascade.estimates.resize(halves.size(), std::vector<float>(halves[0].size(), 0.0f));
        cascade.samples.resize(cascade.level.slots.size(), float(lit.light->rays()));
    }
    addDeposits(levels, cascades);
    return cascades;
}

}  // namespace

PipelineReport bakeLight(const Scene& scene, const LightOptions& options, const BakeGrids& grids, std::uint32_t seed, const ParallelFor& parallelFor,
                         const std::function<void(const BakedVolume&)>& onFrame) {
    return onBackend(options, [&](const LightOptions& chosen) {
        LightJob job(scene, chosen, seed, parallelFor, {}, grids.grids);
        if (!job.worksAtAll()) throw InputError(scene.name + ": no light is on; expected one to bake");
        BakedVolume volume;
        volume.scene = scene.name;
        volume.mark = markOf(scene);
        volume.libraryVersion = CLV_VERSION;
        volume.anchor = scene.anchor;
        volume.lights = scene.lights;
        volume.camera = grids.camera;
        volume.allBounces = options.allBounces;
        volume.seed = seed;
        volume.layout = job.layout;
        volume.marginCells = grids.marginCells;
        volume.blendCells = grids.blendCells;
        FirstBounce first(job);
        const auto keep = [&](std::uint32_t frame) {
            volume.frame = frame;
            volume.cascades = cascadesFrom(first.levels());
        };
        std::optional<FurtherBounces> further;
        if (job.needs.feedback) further.emplace(job);
        first.run([&](std::uint32_t frame, std::size_t rays, double target) {
            if (further) further->follow(first, rays, target);
            if (options.frames <= 1) return;
            keep(frame);
            onFrame(volume);
        });
        if (first.levels().empty()) throw InputError(scene.name + ": its lights meet no surface; expected light to bake");
        if (options.frames > 1) return job.takeReport();
        keep(0);
        if (further) addDeposits(further->finish(first), volume.cascades);
        onFrame(volume);
        return job.takeReport();
    });
}

}  // namespace clv
