// Pictures made of light at the surfaces that a camera sees, and of its error.
#pragma once
#include <span>
#include <vector>

#include "bindings/embree/visible_points.h"
#include "bindings/image/image.h"

namespace clv {

// Radiance that leaves the surfaces under `irradiance` (W/m^2, a surface each): albedo * E / pi, W/(m^2 sr); black elsewhere.
Image radianceImage(int width, int height, std::span<const VisibleSurface> surfaces, std::span<const glm::vec3> irradiance);

// The error a pixel, in the sense of pointErrors(), for irradiance averaged over square blocks of `block` pixels: the noise of
// a path-traced truth averages out in a block, what a light volume gets wrong does not. Not a number where nothing is seen.
std::vector<float> blockErrors(int width, int height, int block, std::span<const VisibleSurface> surfaces,
                               std::span<const glm::vec3> estimate, std::span<const glm::vec3> truth);

}  // namespace clv
