// From values to colours that a screen shows: scales for scalars, exposure and tone mapping for irradiance.
#pragma once
#include <span>
#include <string>

#include <glm/glm.hpp>

#include "bindings/image/tone_map.h"

namespace clv {

// A scale from `lo` to `hi` over the colours of heatColor(), or of differences from blue over white to red; values beyond take the
// colour of the end.
struct ColorScale {
    std::string title;  // the quantity and its unit
    double lo = 0.0, hi = 1.0;
    bool difference = false;
    double least = 0.0, most = 0.0;  // of the values that are shown, which may lie beyond the ends

    glm::u8vec3 color(double value) const;
};

// From 0 to a round number that no more than one in twenty of the values exceeds.
ColorScale scaleFor(const std::string& title, std::vector<float> values);
// The same on both sides of 0.
ColorScale differenceScaleFor(const std::string& title, std::vector<float> values);

// What a white Lambertian surface under an irradiance (W/m^2) sends to the eye, tone mapped.
glm::u8vec3 screenColor(const glm::vec3& radiance, const Exposure& exposure);

// The exposure that fits these radiances, W/(m^2 sr), brightened by `stops` powers of two.
Exposure exposureFor(std::span<const glm::vec3> radiance, double stops);

}  // namespace clv
