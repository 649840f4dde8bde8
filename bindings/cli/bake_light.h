// The light of a still scene, kept as a volume.
#pragma once
#include <functional>

#include "bindings/cli/bake_grids.h"
#include "bindings/cli/pipeline.h"
#include "bindings/volume_file/baked_volume.h"

namespace clv {

// Calls onFrame for each of the options' frames with the light so far. Two halves of the rays give two estimates; further bounces are
// the same in both. Throws InputError where there is no light to keep, and see lightPoints.
PipelineReport bakeLight(const Scene& scene, const LightOptions& options, const BakeGrids& grids, std::uint32_t seed, const ParallelFor& parallelFor,
                         const std::function<void(const BakedVolume&)>& onFrame);

}  // namespace clv
