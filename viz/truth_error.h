// How well path tracing knows what it says.
#pragma once
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace clv {

// The standard error that half of the points stay below which receive light, in the unit of pointErrors(): a share of max(|T|, 0.05 mean |T|).
// Spans of the same size, W/m^2; 0 where none does.
double medianError(std::span<const float> standardErrors, std::span<const glm::vec3> truth);

}  // namespace clv
