// Light on a Vulkan device: it draws and traces the rays and fills the levels; the processor sets levels up and reads them.
#pragma once
#include "bindings/cli/light_options.h"
#include "bindings/cli/lighting.h"
#include "bindings/cli/stage_clock.h"
#include "bindings/embree/bvh.h"
#include "bindings/embree/embree_scene.h"
#include "bindings/scene/surface_rows.h"
#include "bindings/vulkan/vulkan_device.h"
#include "clv/cpu/parallel.h"

namespace clv {

class VulkanBackend : public LightBackend {
public:
    // As CpuBackend. Throws std::runtime_error with one line where the device cannot be had.
    VulkanBackend(const BackendOptions& options, const EmbreeScene& scene, const EmbreeScene& target, std::uint32_t seed,
                  const ParallelFor& parallelFor, StageClock& clock);

    std::string name() const override { return "vulkan"; }
    std::string device() const override { return device_.info().name; }
    std::unique_ptr<Lighting> makeLighting(const LightingSettings& settings) override;

    // What a lighting is made of.
    struct Parts {
        VulkanDevice& device;
        InjectWay inject;
        const EmbreeScene& scene;
        const Bvh& bvh;              // of what rays are cut at
        const SurfaceRows& surfaces;  // of the same
        bool ownMaps;                // the device renders the lights' maps: rays are cut at the scene itself
        std::uint32_t seed;
        const ParallelFor& parallelFor;
        StageClock& clock;
    };

private:
    VulkanDevice device_;
    const Bvh bvh_;
    const SurfaceRows surfaces_;
    const Parts parts_;
};

}  // namespace clv
