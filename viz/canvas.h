// One picture area: a drawing shown by VTK, its colour bar and its words.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include "viz/color_bar.h"
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

    // A line at the lower right.
    void setStatus(const std::string& text);
    // Lines that stay while drawings change.
    void setMark(const FlatLines& lines);

    // Height below which the colour bar stays, as a share of the window: what is above it is taken.
    void setBarTop(double top) { barTop_ = top; }

    vtkRenderer& renderer() { return *renderer_; }

private:
    void prepareFrame();

    vtkRenderWindow& window_;
    const double share_;  // of the window's width
    double barTop_ = 0.9;
    vtkNew<vtkRenderer> renderer_;
    CubeActors cubes_;
    std::vector<vtkSmartPointer<vtkProp>> props_;
    vtkSmartPointer<vtkActor> mark_;  // null: nothing is marked
    ColorBar bar_;
    vtkNew<vtkTextActor> caption_, panel_, status_;
};

}  // namespace clv
