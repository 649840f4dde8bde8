// Light that surfaces send on, bounce after bounce, each read from the volume of the one before.
#pragma once
#include <functional>

#include "bindings/cli/light_job.h"

namespace clv {

// Takes the light of some levels, times `scale`, on top of what it has.
using TakeLight = std::function<void(std::span<const LitLevel> levels, float scale)>;

// Hands all bounces after the first to `take`, one after the other. `first`: the levels of the first bounce; sent: their light's.
void addFurtherBounces(LightJob& job, std::span<const LitLevel> first, const SentPower& sent, const TakeLight& take);

}  // namespace clv
