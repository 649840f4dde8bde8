// The rule of the thesis as it was published: Brattén and Lindén (2013), "Convergent Light Volumes for Indirect Illumination".
//
// Every cell that a ray crosses but the one it starts in gets max(0, -d n) of its flux on each of six sides, whatever the length of the
// crossing and whatever part of the cell is open; a surface reads the nearest cell in front of it by n^2; frames are blended at a fixed rate.
// The light has no unit: one scale, fitted to the truth of the scene, makes it W/m^2.
#pragma once
#include <memory>

#include "benchmarks/baselines/method.h"

namespace clv {

struct ThesisSettings {
    int resolution = 32;        // about resolution^3 cells
    glm::vec3 gridShift{0.0f};  // of a cell, [0, 1)
    float blend = 0.05f;        // share of a new frame in the history, (0, 1]; the first frame is all of it
};

std::unique_ptr<Method> makeThesis(const ThesisSettings& settings);

}  // namespace clv
