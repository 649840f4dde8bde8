// A slider in the window.
#pragma once
#include <functional>
#include <string>

#include <vtkNew.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkSliderRepresentation2D.h>
#include <vtkSliderWidget.h>

namespace clv {

// Where it lies, as shares of the window from its lower left corner.
struct SliderPlace {
    double left, right, height;
};
// Of a column at the right; row 0 is the uppermost.
SliderPlace sliderInColumn(int row);

class Slider {
public:
    // `show` says a value in words.
    Slider(vtkRenderWindowInteractor& interactor, const SliderPlace& place, const std::string& title, double lo, double hi, double value,
           std::function<void(double)> change, std::function<std::string(double)> show);
    ~Slider();
    Slider(const Slider&) = delete;
    Slider& operator=(const Slider&) = delete;

    // Without telling of a change.
    void set(double value);

private:
    void say();
    void changed();

    std::string title_;
    std::function<void(double)> change_;
    std::function<std::string(double)> show_;
    vtkNew<vtkSliderRepresentation2D> shape_;
    vtkNew<vtkSliderWidget> widget_;
};

}  // namespace clv
