// Light propagation volumes: lit surfaces put their light into a grid as spherical harmonics of two bands, and cells pass it on to their
// six neighbours, past what a second grid knows of blockers.
//
// Kaplanyan and Dachsbacher (2010), "Cascaded Light Propagation Volumes for Real-Time Indirect Illumination", I3D; one cascade, which
// covers the scene. Radiometric: cells hold intensity, W/sr.
#pragma once
#include <memory>

#include "benchmarks/baselines/method.h"

namespace clv {

struct LightPropagationSettings {
    int resolution = 32;        // about resolution^3 cells
    glm::vec3 gridShift{0.0f};  // of a cell, [0, 1)
    int iterations = 16;        // steps to the neighbours; light gets as many cells far
    // What blockers stop, times this: two bands blur a wall so that it lets a quarter through, at least.
    float blocking = 1.0f;
    // Light that falls off along a receiver's normal is taken for its own, and damped.
    bool damped = true;
};

// Traces no rays: a frame puts in one more sample of every texel of the maps, and passes the mean of all on.
std::unique_ptr<Method> makeLightPropagation(const LightPropagationSettings& settings);

}  // namespace clv
