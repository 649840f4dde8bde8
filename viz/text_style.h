// How words look in the window.
#pragma once
#include <string>

#include <vtkTextProperty.h>

namespace clv {

inline constexpr double kBackground[3] = {0.09, 0.09, 0.11};
inline constexpr int kTextSize = 13;        // pixels
inline constexpr double kLineHeight = 1.3;  // of the size of letters

// Readable where surfaces lie behind.
void setText(vtkTextProperty& text);
// Its colours alone.
void setTextColors(vtkTextProperty& text);

// With line breaks at spaces, so that no line is wider, in pixels; a word that is wider stands alone.
std::string wrapped(const std::string& text, double width);

}  // namespace clv
