// A plot as an inset at the lower right.
#pragma once
#include <vtkContextActor.h>
#include <vtkSmartPointer.h>

#include "viz/plot.h"

namespace clv {

// `width` and `height` of the part of the window where it goes, pixels.
vtkSmartPointer<vtkContextActor> actorOf(const Plot& plot, int width, int height);

}  // namespace clv
