#include "bindings/image/bitmap_font.h"

#include <algorithm>
#include <array>

namespace clv {
namespace {

struct Glyph {
    char character;
    std::array<const char*, kGlyphHeight> rows;
};

// clang-format off
constexpr Glyph kGlyphs[] = {
    {'0', {" ### ", "#   #", "#  ##", "# # #", "##  #", "#   #", " ### "}},
    {'1', {"  #  ", " ##  ", "  #  ", "  #  ", "  #  ", "  #  ", " ### "}},
    {'2', {" ### ", "#   #", "    #", "   # ", "  #  ", " #   ", "#####"}},
    {'3', {" ### ", "#   #", "    #", "  ## ", "    #", "#   #", " ### "}},
    {'4', {"   # ", "  ## ", " # # ", "#  # ", "#####", "   # ", "   # "}},
    {'5', {"#####", "#    ", "#### ", "    #", "    #", "#   #", " ### "}},
    {'6', {" ### ", "#    ", "#    ", "#### ", "#   #", "#   #", " ### "}},
    {'7', {"#####", "    #", "   # ", "  #  ", "  #  ", " #   ", " #   "}},
    {'8', {" ### ", "#   #", "#   #", " ### ", "#   #", "#   #", " ### "}},
    {'9', {" ### ", "#   #", "#   #", " ####", "    #", "    #", " ### "}},
    {'.', {"     ", "     ", "     ", "     ", "     ", " ##  ", " ##  "}},
    {'%', {"##   ", "##  #", "   # ", "  #  ", " #   ", "#  ##", "   ##"}},
};
// clang-format on

}  // namespace

int textWidth(std::string_view text, int scale) {
    return text.empty() ? 0 : scale * (int(text.size()) * kGlyphAdvance - (kGlyphAdvance - kGlyphWidth));
}

void drawText(Image& image, int x, int y, int scale, std::string_view text, const glm::vec3& color) {
    for (char character : text) {
        const auto* glyph = std::ranges::find(kGlyphs, character, &Glyph::character);
        if (glyph != std::end(kGlyphs))
            for (int row = 0; row < kGlyphHeight * scale; ++row)
                for (int column = 0; column < kGlyphWidth * scale; ++column) {
                    const int px = x + column, py = y + row;
                    const bool inside = px >= 0 && px < image.width && py >= 0 && py < image.height;
                    if (inside && glyph->rows[std::size_t(row / scale)][column / scale] == '#') image.at(px, py) = color;
                }
        x += kGlyphAdvance * scale;
    }
}

}  // namespace clv
