#include "bindings/image/tone_map.h"

#include <algorithm>
#include <cmath>

namespace clv {

float luminance(const glm::vec3& rgb) {
    return glm::dot(rgb, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

Exposure autoExposure(const Image& radiance) {
    constexpr double kMiddleGrey = 0.18;
    double logSum = 0.0;
    float brightest = 0.0f;
    std::size_t lit = 0;
    for (const glm::vec3& pixel : radiance.pixels) {
        const float value = luminance(pixel);
        if (value > 0.0f && std::isfinite(value)) {
            logSum += std::log(double(value));
            brightest = std::max(brightest, value);
            ++lit;
        }
    }
    if (lit == 0) return {};
    const float scale = float(kMiddleGrey / std::exp(logSum / double(lit)));
    // Not below 1, so that a dim even picture is not stretched to white.
    return {scale, std::max(1.0f, scale * brightest)};
}

Image toneMap(const Image& radiance, const Exposure& exposure) {
    Image display = radiance;
    for (glm::vec3& pixel : display.pixels) pixel = toneMap(pixel, exposure);
    return display;
}

glm::vec3 toneMap(const glm::vec3& radiance, const Exposure& exposure) {
    const glm::vec3 scaled = radiance * exposure.scale;
    const float world = luminance(scaled);
    return scaled * ((1.0f + world / (exposure.white * exposure.white)) / (1.0f + world));
}

}  // namespace clv
