// A cascade as a cloud: what has more of a quantity is denser.
#pragma once
#include <vtkProp.h>
#include <vtkSmartPointer.h>

#include "viz/drawing.h"

namespace clv {

vtkSmartPointer<vtkProp> volumeOf(const GridValues& grid, const ColorScale& scale);

}  // namespace clv
