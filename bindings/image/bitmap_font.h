// A font of 5 x 7 pixels for the numbers on pictures, so that they need no installed font.
#pragma once
#include <string_view>

#include "bindings/image/image.h"

namespace clv {

constexpr int kGlyphWidth = 5;
constexpr int kGlyphHeight = 7;
constexpr int kGlyphAdvance = kGlyphWidth + 1;

// Width in pixels at `scale` screen pixels a font pixel.
int textWidth(std::string_view text, int scale);

// Draws digits, '.' and '%' with the upper left corner at (x, y); other characters stay blank. What lies outside is cut off.
void drawText(Image& image, int x, int y, int scale, std::string_view text, const glm::vec3& color);

}  // namespace clv
