#include "viz/mouse_style.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <vtkCamera.h>
#include <vtkMath.h>
#include <vtkObjectFactory.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

namespace clv {
namespace {

constexpr double kTurn = 200.0;     // degrees, along the width or the height of the window
constexpr double kSteepest = 85.0;  // degrees above or below the horizon
constexpr int kSamePlace = 3;  // pixels that the hand may tremble in a click

}  // namespace

vtkStandardNewMacro(MouseStyle);

void MouseStyle::OnLeftButtonDown() {
    Interactor->GetEventPosition(downX_, downY_);
    dragging_ = grab(downX_, downY_);
    if (!dragging_) vtkInteractorStyleTrackballCamera::OnLeftButtonDown();
}

void MouseStyle::OnMouseMove() {
    if (!dragging_) return vtkInteractorStyleTrackballCamera::OnMouseMove();
    drag(Interactor->GetEventPosition()[0], Interactor->GetEventPosition()[1]);
}

void MouseStyle::OnLeftButtonUp() {
    int x = 0, y = 0;
    Interactor->GetEventPosition(x, y);
    if (dragging_) {
        drop(x, y);
    } else {
        vtkInteractorStyleTrackballCamera::OnLeftButtonUp();
    }
    dragging_ = false;
    if (std::abs(x - downX_) <= kSamePlace && std::abs(y - downY_) <= kSamePlace) click(x, y);
}

void MouseStyle::Rotate() {
    if (!CurrentRenderer) return;
    vtkCamera& camera = *CurrentRenderer->GetActiveCamera();
    const double* forward = camera.GetDirectionOfProjection();
    const double elevation = vtkMath::DegreesFromRadians(std::asin(std::clamp(-forward[1], -1.0, 1.0)));
    if (std::abs(elevation) < kSteepest) camera.SetViewUp(0.0, 1.0, 0.0);
    const int *from = Interactor->GetLastEventPosition(), *to = Interactor->GetEventPosition(), *size = CurrentRenderer->GetRenderWindow()->GetSize();
    camera.Azimuth(kTurn * double(from[0] - to[0]) / size[0]);
    camera.Elevation(std::clamp(elevation + kTurn * double(from[1] - to[1]) / size[1], -kSteepest, kSteepest) - elevation);
    CurrentRenderer->ResetCameraClippingRange();
    Interactor->Render();
}

void MouseStyle::OnKeyPress() {
    if (const char* symbol = Interactor->GetKeySym()) key(symbol);
}

}  // namespace clv
