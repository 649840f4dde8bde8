// The scene's surfaces and the light on its way between them, as shapes.
#pragma once
#include "clv/cpu/parallel.h"
#include "viz/drawing.h"
#include "viz/world.h"

namespace clv {

// Surfaces with the light that the volume gives them, and with direct light, as the view says.
void drawMesh(const BakedVolume& volume, const World& world, const View& view, const ParallelFor& parallelFor, Drawing& drawing);
// Surfaces with how far the volume is from the path-traced truth there, in the sense of p95: |E - T| / max(|T|, 0.05 mean |T|).
void drawError(const BakedVolume& volume, const World& world, const View& view, const ParallelFor& parallelFor, Drawing& drawing);
// Rays from the lights' maps, cut where they hit.
void drawRays(const World& world, const View& view, const ParallelFor& parallelFor, Drawing& drawing);
// The lit texels of the lights' maps, in the colour of what they reflect.
void drawTexels(const World& world, const View& view, const ParallelFor& parallelFor, Drawing& drawing);

}  // namespace clv
