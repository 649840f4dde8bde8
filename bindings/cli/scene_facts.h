// What a scene and the options of a command say about the light to compute, and what follows for its volumes.
#pragma once
#include <cstdint>

#include "bindings/cli/light_options.h"
#include "bindings/scene/scene.h"
#include "clv/cpu/volume.h"
#include "clv/plan/needs.h"

namespace clv {

// What the scene and the options say; whatever moves is left to who moves it.
SceneFacts sceneFacts(const Scene& scene, const LightOptions& options);

// How volumes keep the deposits of about so many rays.
VolumeParts volumeParts(int halves, std::uint64_t rays);

// The grid that covers the scene, with the storage and shift that the options ask for.
ClvVolume volumeOver(const Scene& scene, int resolution, const LightOptions& options);

}  // namespace clv
