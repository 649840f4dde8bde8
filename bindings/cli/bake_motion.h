// The light of lights that move, frame by frame, kept as volumes.
#pragma once
#include <functional>

#include "bindings/cli/bake_grids.h"
#include "bindings/cli/pipeline.h"
#include "bindings/scene/motion.h"
#include "bindings/volume_file/baked_volume.h"

namespace clv {

// Calls onFrame with the light of each of the options' frames, whose rays are those of one frame. One grid over the scene, or cascades that
// follow the camera. Throws InputError.
PipelineReport bakeMotion(const Scene& scene, const Motion& motion, const LightOptions& options, const CascadeOptions& cascades, std::uint32_t seed,
                          const ParallelFor& parallelFor, const std::function<void(const BakedVolume&)>& onFrame);

}  // namespace clv
