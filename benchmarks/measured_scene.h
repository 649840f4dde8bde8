// A scene, points that its cameras see, and the path-traced truth there: what estimates are measured against.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "benchmarks/report/metrics.h"
#include "benchmarks/report/statistics.h"
#include "bindings/cli/pipeline.h"

namespace clv {

struct MeasuredScene {
    Scene scene;
    std::vector<ReferencePoint> points;
    std::vector<glm::vec3> truth;  // W/m^2, indirect light after one bounce
    double truthError = 0.0;       // standard error of the truth, relative like the errors of metrics.h
};

// `samples`: paths a point.
MeasuredScene measureScene(Scene scene, std::size_t points, std::uint64_t samples, const ParallelFor& parallelFor);

// Shift `k` of the grid, in cells: no two alike, none a simple fraction.
std::array<double, 3> cellShift(int k);

// What lightPoints gives at the points, how far it is from the truth, and how it came about.
struct MeasuredLight {
    std::vector<glm::vec3> irradiance;
    ErrorSummary errors;
    PipelineReport report;
};
MeasuredLight measureLight(const MeasuredScene& scene, const LightOptions& options, std::uint32_t seed, const ParallelFor& parallelFor);

}  // namespace clv
