// From radiance to what a screen can show: photographic tone mapping (Reinhard, Stark, Shirley and Ferwerda 2002).
#pragma once
#include "bindings/image/image.h"

namespace clv {

// Relative luminance of linear RGB with Rec. 709 primaries.
float luminance(const glm::vec3& rgb);

// How a picture is brought to the screen. Pictures that are to be compared by eye share one.
struct Exposure {
    float scale = 1.0f;  // multiplies radiance
    float white = 1.0f;  // scaled luminance that becomes 1; larger ones are cut off
};

// Brings the log-average luminance of the lit pixels to middle grey, 0.18 (their equations 1 and 2), and the brightest pixel
// to white.
Exposure autoExposure(const Image& radiance);

// Scales and compresses luminance (their equation 4); hue is kept.
Image toneMap(const Image& radiance, const Exposure& exposure);
glm::vec3 toneMap(const glm::vec3& radiance, const Exposure& exposure);

}  // namespace clv
