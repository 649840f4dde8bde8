#include "viz/canvas.h"

#include <algorithm>

#include <vtkCallbackCommand.h>
#include <vtkLookupTable.h>
#include <vtkTextProperty.h>

#include "viz/plot_actor.h"
#include "viz/volume_prop.h"

namespace clv {
namespace {

constexpr double kBackground[3] = {0.09, 0.09, 0.11};
constexpr int kBarColors = 256, kTextSize = 13, kSmallestText = 8;
constexpr double kLineHeight = 1.3;  // of the size of letters
constexpr int kMargin = 5;           // pixels
constexpr double kBarBottom = 0.06, kBarRoom = 0.14;  // of the window
constexpr double kBarPixels = 112.0;                    // that the bar takes at least, with its labels
// A renderer that is to be drawn this often or oftener is being turned; at rest VTK asks for far less.
constexpr double kTurningRate = 1.0;  // frames/s

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

void setText(vtkTextProperty& text) {
    text.SetFontFamilyToCourier();
    text.SetFontSize(kTextSize);
    text.SetColor(0.92, 0.92, 0.92);
    text.ItalicOff();
    text.BoldOff();
    text.ShadowOff();
    // Readable where surfaces lie behind.
    text.SetBackgroundColor(kBackground[0], kBackground[1], kBackground[2]);
    text.SetBackgroundOpacity(0.6);
}

}  // namespace

Canvas::Canvas(vtkRenderWindow& window, double left, double right) : window_(window), share_(right - left) {
    renderer_->SetViewport(left, 0.0, right, 1.0);
    renderer_->SetBackground(kBackground[0], kBackground[1], kBackground[2]);
    window.AddRenderer(renderer_);
    bar_->SetUnconstrainedFontSize(true);
    setText(*bar_->GetLabelTextProperty());
    // VTK cuts a title that is wider than its bar.
    setText(*barTitle_->GetTextProperty());
    barTitle_->GetTextProperty()->SetJustificationToRight();
    barTitle_->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
    bar_->SetLabelFormat("%-#.3g");
    setText(*caption_->GetTextProperty());
    caption_->GetTextProperty()->SetVerticalJustificationToTop();
    caption_->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
    caption_->SetPosition(0.005, 0.99);
    setText(*panel_->GetTextProperty());
    panel_->SetPosition(kMargin, kMargin);
    renderer_->AddViewProp(caption_);
    renderer_->AddViewProp(panel_);
    vtkNew<vtkCallbackCommand> beforeFrame;
    beforeFrame->SetClientData(this);
    beforeFrame->SetCallback([](vtkObject*, unsigned long, void* canvas, void*) { static_cast<Canvas*>(canvas)->prepareFrame(); });
    renderer_->AddObserver(vtkCommand::StartEvent, beforeFrame);
}

Canvas::~Canvas() {
    renderer_->RemoveAllObservers();
    window_.RemoveRenderer(renderer_);
}

void Canvas::prepareFrame() {
    const double* eye = renderer_->GetActiveCamera()->GetPosition();
    cubes_.prepare(glm::vec3(eye[0], eye[1], eye[2]), window_.GetDesiredUpdateRate() > kTurningRate);
}

void Canvas::show(const Drawing& drawing) {
    for (const auto& prop : props_) renderer_->RemoveViewProp(prop);
    props_.clear();
    cubes_.show(drawing.cubes, *renderer_);
    const auto add = [&](const auto& shape) {
        if (!shape.points.empty()) props_.push_back(actorOf(shape));
    };
    add(drawing.tiles);
    add(drawing.mesh);
    add(drawing.lines);
    add(drawing.points);
    add(drawing.thickLines);
    for (const GridValues& grid : drawing.grids) props_.push_back(volumeOf(grid, *drawing.scale));
    if (drawing.plot) props_.push_back(actorOf(*drawing.plot, int(share_ * window_.GetSize()[0]), window_.GetSize()[1]));
    for (const auto& prop : props_) renderer_->AddViewProp(prop);
    showScale(drawing.scale);
    caption_->SetInput(drawing.caption.c_str());
}

void Canvas::setPanel(const std::string& text) {
    panel_->SetInput(text.c_str());
    // Smaller letters where there are more lines than the window has room for beside the caption.
    const double lines = 2.0 + double(std::ranges::count(text, '\n'));
    panel_->GetTextProperty()->SetFontSize(std::clamp(int(window_.GetSize()[1] / lines / kLineHeight), kSmallestText, kTextSize));
}

void Canvas::placeBar() {
    const int* size = window_.GetSize();
    // Below the caption and the title; as wide as its labels need.
    const double line = kTextSize * kLineHeight / size[1], top = std::min(barTop_, 1.0 - 2.5 * line);
    const double room = std::max(kBarRoom, kBarPixels / (share_ * size[0]));
    bar_->SetPosition(1.0 - room, kBarBottom);
    bar_->SetWidth(0.72 * room);
    bar_->SetHeight(top - kBarBottom);
    barTitle_->SetPosition(0.985, top + 0.2 * line);
}

void Canvas::showScale(const std::optional<ColorScale>& scale) {
    renderer_->RemoveViewProp(bar_);
    renderer_->RemoveViewProp(barTitle_);
    if (!scale) return;
    placeBar();
    bar_->SetLookupTable(tableOf(*scale));
    barTitle_->SetInput(scale->title.c_str());
    renderer_->AddViewProp(bar_);
    renderer_->AddViewProp(barTitle_);
}

}  // namespace clv
