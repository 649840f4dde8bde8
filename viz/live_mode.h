// Live mode: the pipeline runs beside the view, sliders change its settings, lamps follow the mouse.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "viz/live_light.h"
#include "viz/pane.h"
#include "viz/pick.h"
#include "viz/slider.h"

namespace clv {

class LiveMode {
public:
    // The pane must have a scene, and outlive the mode, as must the interactor.
    LiveMode(Pane& pane, const ParallelFor& parallelFor);

    void addSliders(vtkRenderWindowInteractor& interactor);
    // One frame; its light replaces the pane's.
    void frame();
    // The stages of the last frame and what they took.
    std::string times() const;

    // Takes hold of a lamp near the line of sight; false where there is none.
    bool grabLight(const Sight& sight);
    bool holdsLight() const { return grabbed_.has_value(); }
    void dragLight(const vec3& screenNormal, const Sight& sight);
    void dropLight();

private:
    Pane& pane_;
    ParallelFor parallelFor_;
    LiveSettings settings_, used_;
    std::unique_ptr<LiveLight> light_;
    std::vector<std::unique_ptr<Slider>> sliders_;
    std::optional<std::size_t> grabbed_;  // index of the light
};

}  // namespace clv
