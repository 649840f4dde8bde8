// From a volume and a view to a drawing.
#pragma once
#include "bindings/volume_file/baked_volume.h"
#include "viz/drawing.h"
#include "viz/world.h"

namespace clv {

// `world` may be null where the view needs no scene; throws InputError where it does.
Drawing compose(const BakedVolume& volume, const World* world, const View& view, const ParallelFor& parallelFor);

// How `volume` differs from `other` in the view's quantity; in irradiance for cubes. Throws InputError for other views.
Drawing composeDifference(const BakedVolume& volume, const BakedVolume& other, const View& view, const ParallelFor& parallelFor);

}  // namespace clv
