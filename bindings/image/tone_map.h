// From radiance to what a screen can show: photographic tone mapping (Reinhard, Stark, Shirley and Ferwerda 2002).
#pragma once
#include "bindings/image/image.h"

namespace clv {

// Relative luminance of linear RGB with Rec. 709 primaries.
float luminance(const glm::vec3& rgb);

// The factor that brings the log-average luminance of the lit pixels to middle grey, 0.18 (their equations 1 and 2);
// 1 where nothing is lit.
float autoExposure(const Image& radiance);

// Scales by `exposure` and compresses luminance so that `white` and above become 1 (their equation 4); hue is kept.
Image toneMap(const Image& radiance, float exposure, float white = 4.0f);

}  // namespace clv
