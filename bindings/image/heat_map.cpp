#include "bindings/image/heat_map.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bindings/image/bitmap_font.h"

namespace clv {
namespace {

const glm::vec3 kInk(1.0f);
const glm::vec3 kNothing(0.2f);

// The picture is drawn to be seen at about this height; larger ones get larger letters.
constexpr int kHeightPerScale = 360;

std::string percentLabel(double fraction) {
    return fmt::format("{:.6g}%", 100.0 * fraction);
}

// Ticks as round as the top: 1 and 5 are cut into five parts, 2 into four.
int tickCount(double top) {
    const double leading = top / std::pow(10.0, std::floor(std::log10(top) + 1e-9));
    return std::lround(leading) == 2 ? 4 : 5;
}

}  // namespace

glm::vec3 heatColor(float t) {
    t = std::clamp(t, 0.0f, 1.0f);
    const float start = 0.5f, rotations = -1.5f, hue = 1.0f;
    const float angle = 2.0f * 3.14159265f * (start / 3.0f + 1.0f + rotations * t);
    const float amplitude = hue * t * (1.0f - t) / 2.0f;
    const float c = std::cos(angle), s = std::sin(angle);
    const glm::vec3 encoded = t + amplitude * glm::vec3(-0.14861f * c + 1.78277f * s, -0.29227f * c - 0.90649f * s, 1.97294f * c);
    glm::vec3 linear;
    for (int channel = 0; channel < 3; ++channel) linear[channel] = linearFromSrgb(std::clamp(encoded[channel], 0.0f, 1.0f));
    return linear;
}

double niceCeiling(double value) {
    const double decade = std::pow(10.0, std::floor(std::log10(value)));
    // A value that is nice already must not be pushed one step up by rounding.
    const double slack = 1.0 + 1e-9;
    for (double step : {1.0, 2.0, 5.0})
        if (value <= step * decade * slack) return step * decade;
    return 10.0 * decade;
}

Image heatMap(std::span<const float> values, int width, int height, double top) {
    const int scale = std::max(1, height / kHeightPerScale);
    const int ticks = tickCount(top);
    int labelWidth = 0;
    for (int tick = 0; tick <= ticks; ++tick)
        labelWidth = std::max(labelWidth, textWidth(percentLabel(top * tick / ticks), scale));

    const int gap = kGlyphWidth * scale;
    const int barWidth = 3 * kGlyphWidth * scale;
    const int barLeft = width + gap;
    const int labelLeft = barLeft + barWidth + gap;
    const int margin = std::min(kGlyphHeight * scale, height / 4);
    const int barHeight = height - 2 * margin;
    Image picture(labelLeft + labelWidth + gap, height);

    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float value = values[std::size_t(y) * std::size_t(width) + std::size_t(x)];
            picture.at(x, y) = std::isfinite(value) ? heatColor(float(value / top)) : kNothing;
        }
    const auto rowOf = [&](double share) { return margin + int(std::lround((1.0 - share) * (barHeight - 1))); };
    for (int y = margin; y < margin + barHeight; ++y) {
        const float share = float(margin + barHeight - 1 - y) / float(std::max(1, barHeight - 1));
        for (int x = barLeft; x < barLeft + barWidth; ++x) picture.at(x, y) = heatColor(share);
    }
    for (int tick = 0; tick <= ticks; ++tick) {
        const double share = double(tick) / ticks;
        for (int x = barLeft + barWidth; x < barLeft + barWidth + 2 * scale; ++x) picture.at(x, rowOf(share)) = kInk;
        drawText(picture, labelLeft, rowOf(share) - kGlyphHeight * scale / 2, scale, percentLabel(top * share), kInk);
    }
    return picture;
}

}  // namespace clv
