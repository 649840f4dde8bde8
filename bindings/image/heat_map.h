// Scalar fields as pictures: a colour map that brightens with the value, and a bar with numbers beside it.
#pragma once
#include <span>
#include <string>

#include "bindings/image/image.h"

namespace clv {

// Display-ready linear RGB for t in [0, 1] (clamped): the cubehelix of Green 2011 ("A colour scheme for the display of
// astronomical intensity images", equation 2; start 0.5, -1.5 rotations), from black to white with rising brightness.
glm::vec3 heatColor(float t);

// The smallest of 1, 2 and 5 times a power of ten that is not below `value` (> 0).
double niceCeiling(double value);

// A map of `values` (fractions; width * height, row 0 at the top) with a bar on its right that is labelled in percent from
// 0 to `top` (> 0). Values above `top` take its colour; values that are not numbers, where there is nothing to show, are grey.
Image heatMap(std::span<const float> values, int width, int height, double top);

}  // namespace clv
