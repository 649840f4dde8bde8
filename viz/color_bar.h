// The colours of a scale, with numbers beside them and its title above.
#pragma once
#include <array>
#include <string>

#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkTextActor.h>

#include "viz/color_scale.h"

namespace clv {

// The number beside the bar, at a share of its height; with a sign at an end that values lie beyond.
std::string labelOf(const ColorScale& scale, double share);

class ColorBar {
public:
    ColorBar();

    // At the right of a renderer of so many pixels, below `top`, a share of its height, and below its caption.
    void show(const ColorScale& scale, double top, int captionLines, int width, int height, vtkRenderer& renderer);
    void hide(vtkRenderer& renderer);

private:
    static constexpr std::size_t kLabels = 5;

    vtkNew<vtkScalarBarActor> bar_;
    vtkNew<vtkTextActor> title_;
    std::array<vtkNew<vtkTextActor>, kLabels> labels_;
};

}  // namespace clv
