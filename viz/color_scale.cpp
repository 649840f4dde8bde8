#include "viz/color_scale.h"

#include <algorithm>
#include <cmath>

#include "bindings/image/heat_map.h"
#include "clv/math/constants.h"

namespace clv {
namespace {

glm::u8vec3 encoded(const glm::vec3& linear) {
    glm::u8vec3 bytes;
    for (int c = 0; c < 3; ++c) bytes[c] = glm::u8(std::lround(255.0f * srgbFromLinear(std::clamp(linear[c], 0.0f, 1.0f))));
    return bytes;
}

}  // namespace

glm::u8vec3 ColorScale::color(double value) const {
    const float t = float((value - lo) / (hi - lo));
    if (!difference) return encoded(heatColor(t));
    const glm::vec3 blue(33, 102, 172), white(247), red(178, 24, 43);
    const float s = std::clamp(2.0f * t - 1.0f, -1.0f, 1.0f);
    return glm::u8vec3(glm::mix(white, s < 0.0f ? blue : red, std::abs(s)) + 0.5f);
}

ColorScale scaleFor(const std::string& title, std::vector<float> values) {
    std::erase_if(values, [](float value) { return !std::isfinite(value); });
    ColorScale scale{.title = title};
    if (values.empty()) return scale;
    const auto [least, most] = std::ranges::minmax(values);
    scale.least = least, scale.most = most;
    const auto p95 = values.begin() + std::ptrdiff_t(values.size() * 95 / 100);
    std::ranges::nth_element(values, p95);
    if (*p95 > 0.0f) scale.hi = niceCeiling(*p95);
    return scale;
}

ColorScale differenceScaleFor(const std::string& title, std::vector<float> values) {
    std::vector<float> sizes = values;
    for (float& size : sizes) size = std::abs(size);
    ColorScale scale = scaleFor(title, std::move(values));
    scale.hi = scaleFor(title, std::move(sizes)).hi;
    scale.lo = -scale.hi;
    scale.difference = true;
    return scale;
}

glm::u8vec3 screenColor(const glm::vec3& radiance, const Exposure& exposure) {
    return encoded(toneMap(radiance, exposure));
}

Exposure exposureFor(std::span<const glm::vec3> radiance, double stops) {
    Image pixels;
    pixels.width = int(radiance.size()), pixels.height = 1;
    pixels.pixels.assign(radiance.begin(), radiance.end());
    Exposure exposure = autoExposure(pixels);
    exposure.scale *= float(std::exp2(stops));
    return exposure;
}

}  // namespace clv
