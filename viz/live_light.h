// The light pipeline, frame by frame beside the view.
#pragma once
#include <optional>

#include "bindings/cli/stage_clock.h"
#include "clv/cpu/moving_lighting.h"
#include "viz/world.h"

namespace clv {

struct LiveSettings {
    int resolution = 24;             // cells along the scene's longest side
    std::size_t rays = 16 << 10;     // a frame
    uint storage = kClvStorageCube9;
    float historyTime = 2.0f;        // s, > 0: that still light is averaged over
    float movingTime = 0.05f;        // s, > 0: the same where a light moves

    bool operator==(const LiveSettings&) const = default;
};

class LiveLight {
public:
    // One volume over the whole scene. The world must outlive it.
    LiveLight(const World& world, const LiveSettings& settings, const ParallelFor& parallelFor);

    // A frame of the scene's lights as they are now; the light so far replaces what `volume` holds. timestep: s, > 0.
    void frame(float timestep, BakedVolume& volume);
    // s a stage of the last frame.
    const StageClock::Stages& stages() const { return clock_.stages(); }

private:
    const World& world_;
    const LiveSettings settings_;
    const ParallelFor parallelFor_;
    MovingLighting lighting_;
    StageClock clock_;
    std::uint32_t frames_ = 0;
};

}  // namespace clv
