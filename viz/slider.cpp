#include "viz/slider.h"

#include <vtkCallbackCommand.h>
#include <vtkProperty2D.h>
#include <vtkTextProperty.h>

#include "viz/text_style.h"

namespace clv {
namespace {

// Of the window.
constexpr double kLeft = 0.78, kRight = 0.97, kTop = 0.92, kRowHeight = 0.1;

}  // namespace

SliderPlace sliderInColumn(int row) { return {kLeft, kRight, kTop - row * kRowHeight}; }

Slider::Slider(vtkRenderWindowInteractor& interactor, const SliderPlace& place, const std::string& title, double lo, double hi, double value,
               std::function<void(double)> change, std::function<std::string(double)> show)
    : title_(title), change_(std::move(change)), show_(std::move(show)) {
    shape_->SetMinimumValue(lo);
    shape_->SetMaximumValue(hi);
    shape_->SetValue(value);
    shape_->GetPoint1Coordinate()->SetCoordinateSystemToNormalizedDisplay();
    shape_->GetPoint1Coordinate()->SetValue(place.left, place.height);
    shape_->GetPoint2Coordinate()->SetCoordinateSystemToNormalizedDisplay();
    shape_->GetPoint2Coordinate()->SetValue(place.right, place.height);
    shape_->ShowSliderLabelOff();
    shape_->SetTitleHeight(0.018);
    shape_->SetSliderLength(0.015);
    shape_->SetTubeWidth(0.01);
    shape_->SetEndCapLength(0.0);
    setTextColors(*shape_->GetTitleProperty());
    say();
    widget_->SetInteractor(&interactor);
    widget_->SetRepresentation(shape_);
    widget_->SetAnimationModeToJump();
    vtkNew<vtkCallbackCommand> onChange;
    onChange->SetClientData(this);
    onChange->SetCallback([](vtkObject*, unsigned long, void* slider, void*) { static_cast<Slider*>(slider)->changed(); });
    widget_->AddObserver(vtkCommand::InteractionEvent, onChange);
    widget_->EnabledOn();
}

Slider::~Slider() {
    widget_->EnabledOff();
}

void Slider::set(double value) {
    shape_->SetValue(value);
    say();
}

void Slider::say() {
    shape_->SetTitleText((title_ + ": " + show_(shape_->GetValue())).c_str());
}

void Slider::changed() {
    say();
    change_(shape_->GetValue());
}

}  // namespace clv
