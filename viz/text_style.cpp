#include "viz/text_style.h"

namespace clv {
namespace {

constexpr double kLetterWidth = 0.6;  // of the size of letters: Courier's are all alike

}  // namespace

void setText(vtkTextProperty& text) {
    text.SetFontFamilyToCourier();
    text.SetFontSize(kTextSize);
    text.ItalicOff();
    text.BoldOff();
    setTextColors(text);
}

void setTextColors(vtkTextProperty& text) {
    text.SetColor(0.92, 0.92, 0.92);
    text.ShadowOff();
    text.SetBackgroundColor(kBackground[0], kBackground[1], kBackground[2]);
    text.SetBackgroundOpacity(0.6);
}

std::string wrapped(const std::string& text, double width) {
    const auto letters = std::size_t(width / (kLetterWidth * kTextSize));
    std::string lines = text;
    std::size_t begin = 0, space = begin;  // of this line, and the last one in it; `begin` where there is none
    for (std::size_t end = 0; end < lines.size(); ++end) {
        if (lines[end] == '\n') begin = space = end + 1;
        if (lines[end] == ' ') space = end;
        if (space > begin && end >= begin + letters) {
            lines[space] = '\n';
            begin = space = space + 1;
        }
    }
    return lines;
}

}  // namespace clv
