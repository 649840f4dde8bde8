// Mouse and keys of the window: turning, panning and zooming as VTK does it; clicks, drags and keys go to whoever asks.
#pragma once
#include <functional>
#include <string>

#include <vtkInteractorStyleTrackballCamera.h>

namespace clv {

class MouseStyle : public vtkInteractorStyleTrackballCamera {
public:
    static MouseStyle* New();
    vtkTypeMacro(MouseStyle, vtkInteractorStyleTrackballCamera);

    // Pixels, from the lower left corner of the window.
    std::function<bool(int x, int y)> grab;  // whether the left button takes hold of something there; then it is dragged
    std::function<void(int x, int y)> drag, drop;
    std::function<void(int x, int y)> click; // pressed and released in the same place
    std::function<void(const std::string& keySym)> key;

    void OnLeftButtonDown() override;
    void OnLeftButtonUp() override;
    void OnMouseMove() override;
    void OnKeyPress() override;
    // About the vertical: VTK's own way tips the horizon.
    void Rotate() override;
    // VTK's own keys do other things.
    void OnChar() override {}

private:
    int downX_ = 0, downY_ = 0;
    bool dragging_ = false;
};

}  // namespace clv
