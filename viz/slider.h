// A slider at the right of the window.
#pragma once
#include <functional>
#include <string>

#include <vtkNew.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkSliderRepresentation2D.h>
#include <vtkSliderWidget.h>

namespace clv {

class Slider {
public:
    // Row 0 is the uppermost. `show` says a value in words.
    Slider(vtkRenderWindowInteractor& interactor, int row, const std::string& title, double lo, double hi, double value,
           std::function<void(double)> change, std::function<std::string(double)> show);
    ~Slider();
    Slider(const Slider&) = delete;
    Slider& operator=(const Slider&) = delete;

private:
    void changed();

    std::string title_;
    std::function<void(double)> change_;
    std::function<std::string(double)> show_;
    vtkNew<vtkSliderRepresentation2D> shape_;
    vtkNew<vtkSliderWidget> widget_;
};

}  // namespace clv
