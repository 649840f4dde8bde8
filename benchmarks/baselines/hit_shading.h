// Light that leaves the surfaces which rays hit: the lamps' direct light there, shadows seen to.
#pragma once
#include <cstddef>
#include <span>

#include "bindings/embree/embree_scene.h"

namespace clv {

// Rays that are shaded together: they fill packets, and stay in the nearest cache.
inline constexpr std::size_t kShadedRays = 256;

// Traces up to kShadedRays rays, as fast as this library's own, and writes the radiance, W/(m^2 sr), that what they hit sends back along them: albedo / pi times the
// direct irradiance there; 0 where they leave the scene. Returns the number of rays traced, shadow rays among them.
std::size_t traceAndShade(const EmbreeScene& scene, std::span<ClvRay> rays, std::span<ClvHit> hits, std::span<glm::vec3> radiance);

}  // namespace clv
