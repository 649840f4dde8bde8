#include "bindings/image/tone_map.h"

#include <cmath>

namespace clv {

float luminance(const glm::vec3& rgb) {
    return glm::dot(rgb, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

float autoExposure(const Image& radiance) {
    constexpr double kMiddleGrey = 0.18;
    double logSum = 0.0;
    std::size_t lit = 0;
    for (const glm::vec3& pixel : radiance.pixels) {
        const float value = luminance(pixel);
        if (value > 0.0f && std::isfinite(value)) {
            logSum += std::log(double(value));
            ++lit;
        }
    }
    return lit == 0 ? 1.0f : float(kMiddleGrey / std::exp(logSum / double(lit)));
}

Image toneMap(const Image& radiance, float exposure, float white) {
    Image display = radiance;
    for (glm::vec3& pixel : display.pixels) {
        pixel *= exposure;
        const float world = luminance(pixel);
        pixel *= (1.0f + world / (white * white)) / (1.0f + world);
    }
    return display;
}

}  // namespace clv
