#include "viz/mouse_style.h"

#include <cstdlib>

#include <vtkObjectFactory.h>
#include <vtkRenderWindowInteractor.h>

namespace clv {
namespace {

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

void MouseStyle::OnKeyPress() {
    if (const char* symbol = Interactor->GetKeySym()) key(symbol);
}

}  // namespace clv
