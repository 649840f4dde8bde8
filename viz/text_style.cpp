#include "viz/text_style.h"

namespace clv {

void setText(vtkTextProperty& text) {
    text.SetFontFamilyToCourier();
    text.SetFontSize(kTextSize);
    text.SetColor(0.92, 0.92, 0.92);
    text.ItalicOff();
    text.BoldOff();
    text.ShadowOff();
    text.SetBackgroundColor(kBackground[0], kBackground[1], kBackground[2]);
    text.SetBackgroundOpacity(0.6);
}

}  // namespace clv
