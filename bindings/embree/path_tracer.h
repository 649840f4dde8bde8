// The truth: indirect irradiance by path tracing, with its standard error.
#pragma once
#include <cstdint>
#include <span>

#include "bindings/embree/embree_scene.h"
#include "clv/cpu/parallel.h"

namespace clv {

struct ReferenceOptions {
    bool allBounces = false;           // false: light -> surface -> receiver only
    std::uint64_t samplesPerPoint = 4096;
    std::uint32_t seed = 1;
};

struct ReferencePoint {
    glm::vec3 position;  // m, relative to the scene's anchor
    glm::vec3 normal;    // unit length
};

struct ReferenceResult {
    glm::vec3 irradiance;     // W/m^2, linear RGB
    glm::vec3 standardError;  // W/m^2, one standard deviation of the mean
};

// Fills out[i] for points[i] (same sizes). Direct light at the points is not in it.
void referenceIrradiance(const EmbreeScene& scene, std::span<const ReferencePoint> points, const ReferenceOptions& options,
                         const ParallelFor& parallelFor, std::span<ReferenceResult> out);

// Direct irradiance of all lights at a point, shadowed, W/m^2.
glm::vec3 directIrradiance(const EmbreeScene& scene, const glm::vec3& position, const glm::vec3& normal);

}  // namespace clv
