// The light pipeline, frame by frame beside the view.
#pragma once
#include "bindings/cli/moving_light.h"
#include "viz/live_settings.h"
#include "viz/world.h"

namespace clv {

class LiveLight {
public:
    // The world must outlive it. Cascades are as wide as it takes for the coarsest one to hold the scene from `camera`. Throws InputError.
    LiveLight(const World& world, const LiveSettings& settings, const Camera& camera, const ParallelFor& parallelFor);

    // A frame of the scene's lights as they are now, cascades around the camera; the light so far replaces what `volume` holds.
    // timestep: s, > 0.
    void frame(float timestep, const Camera& camera, BakedVolume& volume);
    // s a stage of the last frame.
    const StageClock::Stages& stages() const { return light_.stages(); }

private:
    const World& world_;
    const LiveSettings settings_;
    MovingLight light_;
};

}  // namespace clv
