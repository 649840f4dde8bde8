// Light on the processor: Embree traces, and the library's loops do the rest.
#pragma once
#include "bindings/cli/lighting.h"
#include "bindings/cli/stage_clock.h"
#include "bindings/embree/embree_scene.h"
#include "clv/cpu/parallel.h"

namespace clv {

class CpuBackend : public LightBackend {
public:
    // Lights shine on `scene`, and rays are cut at `target`; seed: of the maps. All must outlive what is made.
    CpuBackend(const EmbreeScene& scene, const EmbreeScene& target, std::uint32_t seed, const ParallelFor& parallelFor, StageClock& clock);

    std::string name() const override { return "cpu"; }
    std::string device() const override { return {}; }
    std::unique_ptr<Lighting> makeLighting(const LightingSettings& settings) override;

private:
    const EmbreeScene& scene_;
    const EmbreeScene& target_;
    std::uint32_t seed_;
    const ParallelFor& parallelFor_;
    StageClock& clock_;
};

}  // namespace clv
