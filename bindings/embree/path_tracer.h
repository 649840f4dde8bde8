// The truth: indirect irradiance by path tracing, with its standard error.
//
// Unbiased: paths start cosine-weighted at the receiver, every hit gathers the direct light of all lamps through shadow rays, and
// with all bounces Russian roulette continues a path with the largest channel of the albedo there as its chance, at most 0.999.
// Where all that paths meet has an albedo of 1 and nothing leaves the scene, the true irradiance is infinite: paths still end
// (after some thousand bounces), but the estimate does not converge. From an albedo of 0.9995 on the variance is infinite.
#pragma once
#include <cstdint>
#include <span>

#include "bindings/embree/embree_scene.h"
#include "clv/cpu/parallel.h"

namespace clv {

struct ReferenceOptions {
    bool allBounces = false;           // false: light -> surface -> receiver only
    std::uint64_t samplesPerPoint = 4096;  // > 0
    std::uint32_t seed = 1;
};

struct ReferencePoint {
    glm::vec3 position;  // m, relative to the scene's anchor
    glm::vec3 normal;    // unit length
};

struct ReferenceResult {
    glm::vec3 irradiance;     // W/m^2, linear RGB
    glm::vec3 standardError;  // W/m^2, one standard deviation of the mean; infinite for a single sample
};

// Samples of a point fall into this many batches (fewer samples: a batch each). Directions are stratified within a batch and
// independent between batches, so that the spread of the batch means gives the standard error without assumptions.
inline constexpr std::uint64_t kReferenceBatches = 64;

// Fills out[i] for points[i] (same sizes). Direct light at the points is not in it. A result follows from the scene, the options,
// the point and its index alone.
void referenceIrradiance(const EmbreeScene& scene, std::span<const ReferencePoint> points, const ReferenceOptions& options,
                         const ParallelFor& parallelFor, std::span<ReferenceResult> out);

// Direct irradiance of all lights at a point, shadowed, W/m^2.
glm::vec3 directIrradiance(const EmbreeScene& scene, const glm::vec3& position, const glm::vec3& normal);

}  // namespace clv
