// The light pipeline frame by frame, for lights that move and volumes that follow a camera.
#pragma once
#include "bindings/cli/stage_clock.h"
#include "bindings/embree/embree_scene.h"
#include "clv/cpu/moving_lighting.h"

namespace clv {

struct MovingLightOptions {
    CascadeDesc cascades;
    uint storage = kClvStorageCube9;
    std::size_t rays = 64 << 10;     // a frame
    float stillTime = kClvFar;       // s, > 0: that still light is averaged over
    float movingTime = 0.05f;        // s, > 0: the same where a light moves
    std::uint32_t seed = 1;
};

// One grid over the whole scene, of about resolution^3 cells.
CascadeDesc gridOver(const Scene& scene, int resolution);
// `count` nested grids of resolution^3 cells. cellSize: m, of the finest one; 0: so that the coarsest one holds the scene from `camera`.
CascadeDesc cascadesAround(const Scene& scene, const Camera& camera, int count, int resolution, double cellSize);
// A camera of the scene as the core sees it.
CameraView viewOf(const Scene& scene, const Camera& camera);

class MovingLight {
public:
    // The scene must outlive it; its lights may change between frames. Throws InputError where there is something wrong with the options.
    MovingLight(const EmbreeScene& scene, const MovingLightOptions& options, const ParallelFor& parallelFor);

    // The volumes go where the camera is; before the first frame, and as often as it moves. Throws InputError, beginning with `place`.
    void moveTo(const CameraView& view, const std::string& place);
    // A frame of the scene's lights as they are now. timestep: s, > 0.
    void frame(float timestep);

    const MovingLighting& lighting() const { return lighting_; }
    const DepositLayout& layout() const { return settings_.layout; }
    std::uint32_t frames() const { return frames_; }
    // s a stage: of the last frame and the move before it, and of all.
    const StageClock::Stages& stages() const { return last_.stages(); }
    const StageClock::Stages& allStages() const { return all_.stages(); }

private:
    template <class Body>
    void time(const std::string& stage, Body&& body) {
        if (ended_) last_ = {};
        ended_ = false;
        const double seconds = StageClock::secondsOf(body);
        last_.add(stage, seconds), all_.add(stage, seconds);
    }

    const EmbreeScene& scene_;
    const MovingLightOptions options_;
    const ParallelFor parallelFor_;
    const MovingLightingSettings settings_;
    MovingLighting lighting_;
    StageClock last_, all_;
    std::uint32_t frames_ = 0;
    bool ended_ = false;  // the stages that follow are those of another frame
};

}  // namespace clv
