// What a camera sees: a surface point behind each pixel, and pictures made of light at those points.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "bindings/embree/path_tracer.h"
#include "bindings/image/image.h"

namespace clv {

// By name, or by index from 0. Throws InputError that lists the scene's cameras.
const Camera& chooseCamera(const Scene& scene, const std::string& nameOrIndex);

struct VisibleSurface {
    std::size_t pixel;      // row by row from the top
    ReferencePoint point;   // the normal faces the camera
    glm::vec3 albedo;       // linear RGB, [0, 1]
};

// The surface at the centre of each pixel, in the order of the pixels; those that look past the scene have none.
// The camera's vertical angle counts, the width follows from the size of the picture.
std::vector<VisibleSurface> visibleSurfaces(const EmbreeScene& scene, const Camera& camera, int width, int height,
                                            const ParallelFor& parallelFor);

// The points alone, in the same order.
std::vector<ReferencePoint> pointsOf(std::span<const VisibleSurface> surfaces);

// Radiance that leaves the surfaces under `irradiance` (W/m^2, a surface each): albedo * E / pi, W/(m^2 sr); black elsewhere.
Image radianceImage(int width, int height, std::span<const VisibleSurface> surfaces, std::span<const glm::vec3> irradiance);

// The error a pixel, in the sense of pointErrors(), for irradiance averaged over square blocks of `block` pixels: the noise of
// a path-traced truth averages out in a block, what a light volume gets wrong does not. Not a number where nothing is seen.
std::vector<float> blockErrors(int width, int height, int block, std::span<const VisibleSurface> surfaces,
                               std::span<const glm::vec3> estimate, std::span<const glm::vec3> truth);

}  // namespace clv
