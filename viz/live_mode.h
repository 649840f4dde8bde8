// Live mode: the pipeline runs beside the view, sliders change its settings, lamps follow the mouse.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings/scene/motion.h"
#include "viz/live_light.h"
#include "viz/pane.h"
#include "viz/pick.h"
#include "viz/slider.h"

namespace clv {

class LiveMode {
public:
    // The pane must have a scene, and outlive the mode, as must the interactor. `viewCamera`: the view's, for cascades that follow it.
    // Throws InputError.
    LiveMode(Pane& pane, const LiveOptions& options, std::function<Camera()> viewCamera, const ParallelFor& parallelFor);

    void addSliders(vtkRenderWindowInteractor& interactor);
    // One frame; its light replaces the pane's.
    void frame();
    // The stages of the last frame and what they took.
    std::string times() const;
    // Whether the cascades go where the view is; else they stay where they are, or go where the motion says.
    void toggleFollowing() { options_.follow = !options_.follow; }

    // Takes hold of a lamp near the line of sight; false where there is none.
    bool grabLight(const Sight& sight);
    bool holdsLight() const { return grabbed_.has_value(); }
    void dragLight(const vec3& screenNormal, const Sight& sight);
    void dropLight();

private:
    void putLamps();
    void move();

    Pane& pane_;
    LiveOptions options_;
    std::function<Camera()> viewCamera_;
    ParallelFor parallelFor_;
    LiveSettings used_;
    std::optional<Scene> still_;           // lights before they move
    std::optional<Motion> motion_;
    std::uint32_t frames_ = 0;
    Camera camera_;                        // that the cascades stand around
    std::unique_ptr<LiveLight> light_;
    std::vector<std::unique_ptr<Slider>> sliders_;
    std::optional<std::size_t> grabbed_;  // index of the light
};

}  // namespace clv
