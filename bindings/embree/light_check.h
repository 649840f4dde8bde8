// What the lights of a scene meet first, before anything is built on it.
#pragma once
#include <string>
#include <vector>

#include "bindings/embree/embree_scene.h"
#include "clv/cpu/parallel.h"

namespace clv {

struct LightCheck {
    std::vector<std::string> idle;   // names of lights that are on and meet no surface: too far away, or turned away from everything
    double shareOnBacks = 0.0;       // of the flux that meets something, how much meets backs of surfaces first
    std::vector<double> shares;      // of that flux, each light's
    // m, each light's: a quarter of what it sends towards the scene meets surfaces within it; kClvFar where less meets any, and for the sun.
    std::vector<float> reach;
};

// Follows a few hundred rays of each light that is on.
LightCheck checkLights(const EmbreeScene& scene, const ParallelFor& parallelFor);

// Turns every triangle around.
void turnFaces(Scene& scene);

}  // namespace clv
