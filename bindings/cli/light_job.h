// What the light pipeline works on: the scene, who reads its light, the back end, and what is said of it afterwards.
#pragma once
#include <memory>
#include <optional>

#include "bindings/cli/light_options.h"
#include "bindings/cli/lit_level.h"
#include "bindings/cli/noise.h"
#include "bindings/cli/pipeline.h"
#include "bindings/cli/stage_clock.h"
#include "bindings/cli/surroundings.h"
#include "clv/plan/needs.h"

namespace clv {

struct LightJob {
    // All must outlive the job. Takes nothing where there is no light or nobody to read it. grids: all of whose cells are wanted, in
    // place of those that the points read.
    LightJob(const Scene& scene, const LightOptions& options, std::uint32_t seed, const ParallelFor& parallelFor, std::span<const ReferencePoint> points,
             std::vector<ClvVolume> grids = {});

    bool worksAtAll() const { return needs.stages && !(points.empty() && grids.empty()); }

    // About resolution^3 cells, with slots where receivers read.
    Level makeLevel(int resolution);
    // With slots wherever there is open space.
    Level makeLevel(const ClvVolume& grid);
    std::shared_ptr<const Lookups> makeLookups(const Level& level);
    LitLevel makeLit(Lighting& lighting, int resolution, Level level, std::shared_ptr<const Lookups> lookups);
    // stream: each lighting has one of its own, from which the seed of its rays follows.
    LightingSettings lightingSettings(int halves, std::uint64_t rays, std::uint32_t stream) const;
    std::unique_ptr<Lighting> makeLighting(const LightingSettings& settings);
    // E at the points, W/m^2, is added to `sum`.
    void evaluate(std::span<const LitLevel> levels, std::span<glm::vec3> sum);
    // Tells the report how noisy the sum of both is at the points, where the halves of the rays can say.
    void judgeNoise(std::span<const LitLevel> first, std::span<const LitLevel> later);
    // What is said once all is done; the job's own report is left empty.
    PipelineReport takeReport();

    const Scene& scene;
    const LightOptions& options;
    const std::uint32_t seed;
    const ParallelFor& parallelFor;
    const Needs needs;
    const bool automatic;  // the resolution is chosen here
    const std::vector<ClvVolume> grids;  // finest first; empty: levels are made for the points
    const int halves;      // of the rays
    const DepositLayout layout;
    std::vector<ClvReceiver> points, judges;
    StageClock clock;
    PipelineReport report;

private:
    int finestResolution() const;
    // Cells from points to what they see: in nearSight(). Of fewer than two the light is inexact; where there is less than one, places are lost.
    float cellsInSight(int resolution) const;
    void heedScene();
    void chooseJudges();

    std::vector<Look> looks_;  // of the points
    float sight_ = kClvFar;    // m, from which they see surfaces: nearSight()
    std::optional<EmbreeScene> embree_, proxy_;
    std::optional<Scene> proxyScene_, turned_;
    std::unique_ptr<LightBackend> backend_;
};

}  // namespace clv
