// The frame in which boxes along the axes fit a scene's triangles most tightly.
#pragma once
#include "bindings/scene/scene.h"

namespace clv {

// A rotation about the middle of the scene, so that coordinates stay small: less is rounded away than the scene's own lose.
struct TightFrame {
    glm::vec3 center{0.0f};      // m
    glm::mat3 rotation{1.0f};

    glm::vec3 direction(const glm::vec3& d) const { return rotation * d; }
    glm::vec3 point(const glm::vec3& p) const { return rotation * (p - center); }
};

// The cost of a ray's way through a hierarchy of boxes grows with their surfaces (Goldsmith and Salmon 1987). A building that stands
// askew to the axes has walls whose boxes are mostly air: turned upright, it is traced several times as fast. The rotation is the
// identity where no frame is better by a clear margin.
TightFrame findTightFrame(const Scene& scene);

}  // namespace clv
