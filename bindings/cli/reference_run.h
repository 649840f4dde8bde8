// The path tracer, run for a number of samples, for a time, or until it is exact enough.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <CLI/App.hpp>

#include "bindings/embree/path_tracer.h"

namespace clv {

struct ReferenceBudget {
    std::uint64_t samples = 4096;  // a point; counts where neither of the others is set
    double seconds = 0.0;          // run time, s; 0: not set
    double targetError = 0.0;      // relativeStandardError() to reach; 0: not set
};
// --samples, --seconds and --target-error, of which one may be given.
void addReferenceBudget(CLI::App& command, ReferenceBudget& budget);

struct ReferenceRun {
    std::vector<ReferenceResult> results;  // a point each
    std::uint64_t samplesPerPoint = 0;
    double seconds = 0.0;                  // run time, s

    std::vector<glm::vec3> irradiance() const;     // W/m^2, a point each
    std::vector<glm::vec3> standardError() const;  // W/m^2, a point each
};

// Runs in independent passes with a seed each where the budget asks for more than a number of samples.
ReferenceRun runReference(const EmbreeScene& scene, std::span<const ReferencePoint> points, const ReferenceBudget& budget,
                          bool allBounces, std::uint32_t seed, const ParallelFor& parallelFor);

// Joins a pass of `passSamples` a point to the mean of `samples` a point; the two are independent.
void joinPass(std::span<ReferenceResult> mean, std::uint64_t samples, std::span<const ReferenceResult> pass, std::uint64_t passSamples);

// Root of the mean squared standard error over points and channels, over the mean irradiance: what the reference's own noise
// adds to a relative RMSE against it.
double relativeStandardError(std::span<const ReferenceResult> results);
// Mean standard error over points and channels, W/m^2.
double meanStandardError(std::span<const ReferenceResult> results);

}  // namespace clv
