#include "viz/canvas.h"

#include <algorithm>

#include <vtkCallbackCommand.h>
#include <vtkTextProperty.h>

#include "viz/plot_actor.h"
#include "viz/text_style.h"
#include "viz/volume_prop.h"

namespace clv {
namespace {

constexpr int kSmallestText = 8, kMargin = 5;  // pixels
constexpr double kCaptionMargin = 0.005;       // of the width
// A renderer that is to be drawn this often or oftener is being turned; at rest VTK asks for far less.
constexpr double kTurningRate = 1.0;  // frames/s

}  // namespace

Canvas::Canvas(vtkRenderWindow& window, double left, double right) : window_(window), share_(right - left) {
    renderer_->SetViewport(left, 0.0, right, 1.0);
    renderer_->SetBackground(kBackground[0], kBackground[1], kBackground[2]);
    window.AddRenderer(renderer_);
    setText(*caption_->GetTextProperty());
    caption_->GetTextProperty()->SetVerticalJustificationToTop();
    caption_->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
    caption_->SetPosition(kCaptionMargin, 0.99);
    setText(*panel_->GetTextProperty());
    panel_->SetPosition(kMargin, kMargin);
    renderer_->AddViewProp(caption_);
    setText(*status_->GetTextProperty());
    status_->GetTextProperty()->SetJustificationToRight();
    status_->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
    status_->SetPosition(0.99, 0.01);
    renderer_->AddViewProp(panel_);
    renderer_->AddViewProp(status_);
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
    add(drawing.signs);
    for (const GridValues& grid : drawing.grids) props_.push_back(volumeOf(grid, *drawing.scale));
    const int width = int(share_ * window_.GetSize()[0]), height = window_.GetSize()[1];
    if (drawing.plot) props_.push_back(actorOf(*drawing.plot, width, height));
    for (const auto& prop : props_) renderer_->AddViewProp(prop);
    bar_.hide(*renderer_);
    const std::string caption = wrapped(drawing.caption, (1.0 - 2.0 * kCaptionMargin) * width);
    caption_->SetInput(caption.c_str());
    const int captionLines = 1 + int(std::ranges::count(caption, '\n'));
    if (drawing.scale) bar_.show(*drawing.scale, barTop_, captionLines, width, height, *renderer_);
}

void Canvas::setPanel(const std::string& text) {
    panel_->SetInput(text.c_str());
    // Smaller letters where there are more lines than the window has room for beside the caption.
    const double lines = 2.0 + double(std::ranges::count(text, '\n'));
    panel_->GetTextProperty()->SetFontSize(std::clamp(int(window_.GetSize()[1] / lines / kLineHeight), kSmallestText, kTextSize));
}

void Canvas::setStatus(const std::string& text) {
    status_->SetInput(text.c_str());
}

void Canvas::setMark(const FlatLines& lines) {
    if (mark_) renderer_->RemoveViewProp(mark_);
    mark_ = lines.points.empty() ? nullptr : actorOf(lines);
    if (mark_) renderer_->AddViewProp(mark_);
}

}  // namespace clv
