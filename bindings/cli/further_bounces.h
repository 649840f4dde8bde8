// Light that surfaces send on, bounce after bounce, each read from the volume of the one before.
#pragma once
#include "bindings/cli/light_job.h"

namespace clv {

// Adds E of all bounces after the first at the points, W/m^2, to `sum`. `first`: the levels of the first bounce; sent: their light's.
void addFurtherBounces(LightJob& job, std::span<const LitLevel> first, const SentPower& sent, std::span<glm::vec3> sum);

}  // namespace clv
