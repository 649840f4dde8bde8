#include "bindings/cli/light_job.h"

#include <cmath>

#include <fmt/format.h>

#include "bindings/cli/cpu_lighting.h"
#include "bindings/cli/heed_lights.h"
#include "bindings/cli/heed_points.h"
#include "bindings/cli/scene_facts.h"
#include "bindings/cli/vulkan_lighting.h"
#include "bindings/embree/light_check.h"
#include "bindings/embree/visible_points.h"
#include "clv/cpu/build_level.h"
#include "clv/cpu/resolution.h"

namespace clv {
namespace {

constexpr std::size_t kJudges = 1024;              // receivers that choose the resolution, and points that say how noisy they are
constexpr std::size_t kFewJudges = 500;            // below this, points that the cameras see judge too
constexpr double kMuchNoise = 0.3, kManyNoisy = 0.1, kManyDark = 0.1;  // above which they are said
constexpr float kExact = 2.0f;                     // cells in sight, below which light is said to be inexact

void moveTo(Scene& scene, const glm::dvec3& anchor) {
    const vec3 offset(scene.anchor - anchor);
    for (vec3& p : scene.positions) p += offset;
    scene.bounds.lo += offset, scene.bounds.hi += offset;
    scene.anchor = anchor;
}

}  // namespace

LightJob::LightJob(const Scene& s, const LightOptions& o, std::uint32_t seedOfAll, const ParallelFor& parallel, std::span<const ReferencePoint> readers,
                   std::vector<ClvVolume> wholeGrids)
    : scene(s), options(o), seed(seedOfAll), parallelFor(parallel), needs(planNeeds(sceneFacts(s, o))), automatic(needs.halves > 1 && wholeGrids.empty()),
      grids(std::move(wholeGrids)), halves(grids.empty() ? needs.halves : 2), layout{o.storage, needs.channels, needs.frame}, points(receiversOf(readers)) {
    report.backend = options.backend.choice;
    if (!worksAtAll()) return;
    report.channels = needs.channels;
    report.sweeps = 1;
    clock.time("setup", [&] {
        embree_.emplace(scene);
        if (!options.proxy.empty()) {
            proxyScene_ = loadScene(options.proxy);
            moveTo(*proxyScene_, scene.anchor);
            proxy_.emplace(*proxyScene_);
        }
        heedScene();
        if (automatic) chooseJudges();
        const EmbreeScene& target = proxy_ ? *proxy_ : *embree_;
        if (options.backend.choice == "vulkan") {
            backend_ = std::make_unique<VulkanBackend>(options.backend, *embree_, target, seed, parallelFor, clock);
        } else {
            backend_ = std::make_unique<CpuBackend>(*embree_, target, seed, parallelFor, clock);
        }
    });
    report.device = backend_->device();
}

void LightJob::heedScene() {
    const int coarsest = options.resolution > 0 ? options.resolution : resolutionsFor(double(options.rays)).front();
    const LightHeed heed = clv::heedLights(*embree_, volumeOver(scene, coarsest, options).cellSize, options.seconds > 0.0 ? 0.0 : double(options.rays), parallelFor);
    report.warnings.insert(report.warnings.end(), heed.warnings.begin(), heed.warnings.end());
    if (heed.insideOut) {
        turned_ = scene;
        turnFaces(*turned_);
        embree_.emplace(*turned_);
        if (proxyScene_) {
            turnFaces(*proxyScene_);
            proxy_.emplace(*proxyScene_);
        }
    }
    looks_ = lookAround(*embree_, points, parallelFor);
    sight_ = nearSight(looks_);
    const PointHeed pointHeed = heedPoints(*embree_, points, looks_, heed.sheets, parallelFor);
    report.warnings.insert(report.warnings.end(), pointHeed.warnings.begin(), pointHeed.warnings.end());
    embree_->setSolids(!pointHeed.sheets);
    if (grids.empty() && cellsInSight(finestResolution()) < kExact)
        report.warnings.push_back(fmt::format("a tenth of the points see surfaces from {:.2g} m or nearer, where the smallest cells are {:.2g} m wide: their light is inexact, or "
                                              "missing; a larger --resolution or less of a scene has smaller cells",
                                              sight_, volumeOver(scene, finestResolution(), options).cellSize));
}

// Some of the points, and with few of them some that the cameras see.
void LightJob::chooseJudges() {
    const std::size_t count = std::min(points.size(), kJudges);
    for (std::size_t k = 0; k < count; ++k) judges.push_back(points[k * points.size() / count]);
    if (count < kFewJudges) {
        const auto seen = visiblePoints(*embree_, kFewJudges, clvHashCombine(seed, 0x9u));
        judges.insert(judges.end(), seen.begin(), seen.end());
    }
}

Level LightJob::makeLevel(int resolution) {
    Level level;
    clock.time("setup", [&] {
        const ClvVolume volume = volumeOver(scene, resolution, options);
        std::vector<std::uint8_t> needed = neededCells(volume, points);
        const std::vector<std::uint8_t> also = neededCells(volume, judges);
        for (std::size_t i = 0; i < needed.size(); ++i) needed[i] |= also[i];
        level = buildLevel(volume, embree_->probe(), needed, parallelFor);
    });
    return level;
}

Level LightJob::makeLevel(const ClvVolume& grid) {
    Level level;
    clock.time("setup", [&] { level = buildLevel(grid, embree_->probe(), {}, parallelFor); });
    return level;
}

std::shared_ptr<const Lookups> LightJob::makeLookups(const Level& level) {
    std::shared_ptr<const Lookups> lookups;
    clock.time("setup", [&] {
        const auto of = [&](const std::vector<ClvReceiver>& receivers) { return LookupTable(level, receivers, {}, parallelFor); };
        lookups = std::make_shared<const Lookups>(Lookups{of(points), of(judges)});
    });
    return lookups;
}

LitLevel LightJob::makeLit(Lighting& lighting, int resolution, Level level, std::shared_ptr<const Lookups> lookups) {
    LitLevel lit{.resolution = resolution, .light = nullptr, .lookups = std::move(lookups)};
    clock.time("setup", [&] { lit.light = lighting.makeLevel(std::move(level)); });
    return lit;
}

float LightJob::cellsInSight(int resolution) const { return sight_ / volumeOver(scene, resolution, options).cellSize; }

int LightJob::finestResolution() const { return automatic ? kResolutions[std::size(kResolutions) - 1] : options.resolution; }

LightingSettings LightJob::lightingSettings(int halves, std::uint64_t rays, std::uint32_t stream) const {
    return {.layout = layout, .halves = halves, .rays = rays, .seed = clvHashCombine(seed, stream), .keepHits = needs.feedback,
            .finest = volumeOver(scene, finestResolution(), options)};
}

std::unique_ptr<Lighting> LightJob::makeLighting(const LightingSettings& settings) {
    std::unique_ptr<Lighting> lighting;
    clock.time("setup", [&] { lighting = backend_->makeLighting(settings); });
    return lighting;
}

void LightJob::evaluate(std::span<const LitLevel> levels, std::span<glm::vec3> sum) {
    clock.time("evaluate", [&] { addIrradiance(levels, &Lookups::points, layout, points, parallelFor, sum); });
}

// Half of the difference between the halves is a sample of the error of their mean.
void LightJob::judgeNoise(std::span<const LitLevel> first, std::span<const LitLevel> later) {
    if (halves != 2 || points.empty()) return;
    clock.time("noise", [&] {
        HalfEstimates estimates;
        for (auto& half : estimates.half) half.resize(std::min(points.size(), kJudges), glm::vec3(0.0f));
        for (const auto& levels : {first, later}) {
            for (const LitLevel& level : levels) addHalves(level, &Lookups::points, layout, points, float(level.weight), parallelFor, estimates);
        }
        report.noise = noiseOf(estimates.half[0], estimates.half[1]);
    });
    if (report.noise->dark > kManyDark)
        report.warnings.push_back(fmt::format("{:.0f} % of the points got no light: they are dark, or too few rays came by", 100.0 * report.noise->dark));
    if (report.noise->ofMean > kMuchNoise || report.noise->noisy > kManyNoisy)
        report.warnings.push_back(fmt::format("the light at the points is noisy: its standard error is about {:.0f} % of its mean, and {:.0f} % of the points are off by more than {:.0f} % "
                                              "of their own light; more --rays or --seconds would be less so",
                                              100.0 * report.noise->ofMean, 100.0 * report.noise->noisy, 100.0 * kNoisy));
}

PipelineReport LightJob::takeReport() {
    report.stages = clock.stages();
    report.frameSeconds = clock.of({"guide", "rays", "trace", "inject", "merge", "walk", "choose", "evaluate"});
    return std::move(report);
}

}  // namespace clv
