// One picture area: a drawing shown by VTK, its colour bar and its words.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include "viz/drawing.h"

namespace clv {

class Canvas {
public:
    // The part of the window between `left` and `right`, [0, 1]. The window must outlive the canvas.
    Canvas(vtkRenderWindow& window, double left, double right);
    ~Canvas();
    Canvas(const Canvas&) = delete;
    Canvas& operator=(const Canvas&) = delete;

    void show(const Drawing& drawing);
    // Lines of text at the left, below the caption.
    void setPanel(const std::string& text);

    vtkRenderer& renderer() { return *renderer_; }

private:
    void showScale(const std::optional<ColorScale>& scale);
    void prepareFrame();

    vtkRenderWindow& window_;
    const double share_;  // of the window's width
    vtkNew<vtkRenderer> renderer_;
    CubeActors cubes_;
    std::vector<vtkSmartPointer<vtkProp>> props_;
    vtkNew<vtkScalarBarActor> bar_;
    vtkNew<vtkTextActor> caption_, panel_;
};

}  // namespace clv
