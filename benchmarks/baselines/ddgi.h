// Dynamic diffuse global illumination: a grid of probes that keep irradiance and distance as octahedral maps, filled by rays of their
// own, and read through a visibility test.
//
// Majercik, Guertin, Nowrouzezahrai, McGuire (2019), "Dynamic Diffuse Global Illumination with Ray-Traced Irradiance Fields", JCGT 8(2);
// probes moved and switched off: Majercik, Marrs, Spjut, McGuire (2021), "Scaling Probe-Based Real-Time Dynamic Global Illumination
// for Production", JCGT 10(2).
#pragma once
#include <memory>

#include "benchmarks/baselines/readers.h"

namespace clv {

struct DdgiSettings {
    int resolution = 16;                    // about resolution^3 probes
    glm::vec3 gridShift{0.0f};              // of a spacing, [0, 1)
    Readers readers = Readers::surfaces;    // anywhere: all probes
    // Share of the old value that a frame leaves, but never more than (n - 1) / n after n frames. 0.97 in the papers; 1 keeps the mean
    // of all frames.
    float hysteresis = 0.97f;
    // Irradiance is kept, and blended, as its root of this order: 5 in the papers; 1 keeps it linear.
    float encoding = 5.0f;
    // A frame's rays are a Fibonacci lattice, turned at random, as in the papers: the least noise in one frame. Otherwise they go on in one
    // Owen-scrambled Sobol' sequence: the least in the mean of many.
    bool turnedRays = true;
    // Distances are measured once, for a scene that stands still, instead of by the rays of each frame as in the papers.
    bool distancesOnce = true;
    // Receivers stand still: their weights are found at set-up, not at each reading. For distances that are measured once.
    bool keptWeights = true;
};

// A frame sends the same number of rays, at least one, from every probe.
std::unique_ptr<Method> makeDdgi(const DdgiSettings& settings);

}  // namespace clv
