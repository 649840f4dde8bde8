// How words look in the window.
#pragma once
#include <vtkTextProperty.h>

namespace clv {

inline constexpr double kBackground[3] = {0.09, 0.09, 0.11};
inline constexpr int kTextSize = 13;        // pixels
inline constexpr double kLineHeight = 1.3;  // of the size of letters

// Readable where surfaces lie behind.
void setText(vtkTextProperty& text);

}  // namespace clv
