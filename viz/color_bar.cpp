#include "viz/color_bar.h"

#include <algorithm>

#include <fmt/format.h>
#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>
#include <vtkTextProperty.h>

#include "viz/text_style.h"

namespace clv {
namespace {

constexpr int kBarColors = 256;
constexpr double kBottom = 0.06, kRoom = 0.14;  // of the height and of the width of the renderer
constexpr double kLeastRoom = 128.0;            // pixels, for the bar and its labels
constexpr double kBarShare = 0.27;              // of that room
constexpr double kGap = 4.0;                    // pixels between the bar and the labels

vtkSmartPointer<vtkLookupTable> tableOf(const ColorScale& scale) {
    auto table = vtkSmartPointer<vtkLookupTable>::New();
    table->SetNumberOfTableValues(kBarColors);
    table->SetTableRange(scale.lo, scale.hi);
    for (int i = 0; i < kBarColors; ++i) {
        const glm::u8vec3 color = scale.color(scale.lo + (scale.hi - scale.lo) * i / (kBarColors - 1));
        table->SetTableValue(i, color.x / 255.0, color.y / 255.0, color.z / 255.0, 1.0);
    }
    return table;
}

}  // namespace

std::string labelOf(const ColorScale& scale, double share) {
    const double value = scale.lo + share * (scale.hi - scale.lo);
    const char* sign = share == 1.0 && scale.most > scale.hi ? ">= " : share == 0.0 && scale.least < scale.lo ? "<= " : "";
    return fmt::format("{}{:#.3g}", sign, value);
}

ColorBar::ColorBar() {
    // VTK cuts a title that is wider than its bar, and has no signs before its numbers.
    bar_->DrawTickLabelsOff();
    bar_->SetBarRatio(1.0);
    setText(*title_->GetTextProperty());
    title_->GetTextProperty()->SetJustificationToRight();
    title_->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
    for (const auto& label : labels_) {
        setText(*label->GetTextProperty());
        label->GetTextProperty()->SetVerticalJustificationToCentered();
        label->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
    }
}

void ColorBar::show(const ColorScale& scale, double top, int captionLines, int width, int height, vtkRenderer& renderer) {
    // The caption stays free above the title, and half a line for the top label below it.
    const double line = kTextSize * kLineHeight / height, barTop = std::min(top, 1.0 - (captionLines + 2.2) * line);
    const double room = std::max(kRoom, kLeastRoom / width), left = 1.0 - room;
    bar_->SetLookupTable(tableOf(scale));
    bar_->SetPosition(left, kBottom);
    bar_->SetWidth(kBarShare * room);
    bar_->SetHeight(barTop - kBottom);
    title_->SetInput(scale.title.c_str());
    title_->SetPosition(0.985, barTop + 0.8 * line);
    renderer.AddViewProp(bar_);
    renderer.AddViewProp(title_);
    for (std::size_t k = 0; k < kLabels; ++k) {
        const double share = double(k) / double(kLabels - 1);
        labels_[k]->SetInput(labelOf(scale, share).c_str());
        labels_[k]->SetPosition(left + kBarShare * room + kGap / width, kBottom + share * (barTop - kBottom));
        renderer.AddViewProp(labels_[k]);
    }
}

void ColorBar::hide(vtkRenderer& renderer) {
    renderer.RemoveViewProp(bar_);
    renderer.RemoveViewProp(title_);
    for (const auto& label : labels_) renderer.RemoveViewProp(label);
}

}  // namespace clv
