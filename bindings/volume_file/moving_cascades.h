// Cascades that follow a camera, kept as they are at one moment.
#pragma once
#include "bindings/volume_file/baked_volume.h"
#include "clv/cpu/moving_lighting.h"

namespace clv {

// A cascade whose cells lie in memory as they lie in space, with slots in the order of their cells. raysPerFrame: what a frame of its
// history stands for.
BakedCascade cascadeFrom(const MovingVolume& volume, const DepositLayout& layout, double raysPerFrame);

// Replaces the cascades of `volume` and where they stand; volume.layout must be the one that `lighting` was made with.
void keepCascades(const MovingLighting& lighting, double raysPerFrame, BakedVolume& volume);

}  // namespace clv
