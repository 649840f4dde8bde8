// Trials of this library in scenes, for forecasts of cost and error.
#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "benchmarks/baselines/method.h"
#include "benchmarks/report/cost_model.h"
#include "benchmarks/report/scene_truth.h"

namespace clv {

inline constexpr std::size_t kTrialPoints = 1000;

// Points with a path-traced truth, and the number of readers that times are for.
struct TrialScene {
    TrialScene(const EmbreeScene& scene, double readers, const ParallelFor& parallelFor, std::size_t points = kTrialPoints);

    const EmbreeScene& scene;
    const double readers;
    const ParallelFor& parallelFor;
    std::vector<ReferencePoint> points;
    std::vector<glm::vec3> truth;
    double truthError = 0.0;
};

// A resolution that is ready for frames.
class TrialRun {
public:
    TrialRun(const TrialScene& scene, int resolution);
    ~TrialRun();

    Trial trial();
    // Least time of some frames of `rays`, and their error without the noise of the truth.
    Outcome measure(double rays, int repeats);

private:
    struct Frames;
    Frames run(double rays, int repeats);

    const TrialScene& scene_;
    const int resolution_;
    std::unique_ptr<Method> method_;
};

// Resolutions that are tried.
inline constexpr int kTrialResolutions[] = {8, 16, 32, 64};

// Fits the model to trials in scenes of its own; about a minute on two cores.
CostModel calibrate(double readers, const ParallelFor& parallelFor, const std::function<void(double)>& onProgress);

}  // namespace clv
