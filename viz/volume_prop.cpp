#include "viz/volume_prop.h"

#include <algorithm>
#include <cmath>

#include <vtkColorTransferFunction.h>
#include <vtkFixedPointVolumeRayCastMapper.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkUnsignedShortArray.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

namespace clv {
namespace {

// Steps of the scale; step 0 is a cell that is not shown.
constexpr double kSteps = 1024.0;
constexpr double kDensest = 0.25;     // opacity of the densest cell, a cell deep
constexpr float kSampleShare = 0.5f;  // of a cell, between samples along a line of sight

}  // namespace

vtkSmartPointer<vtkProp> volumeOf(const GridValues& grid, const ColorScale& scale) {
    const ClvVolume& g = grid.grid;
    vtkNew<vtkUnsignedShortArray> steps;
    steps->SetNumberOfTuples(vtkIdType(grid.values.size()));
    for (std::size_t i = 0; i < grid.values.size(); ++i) {
        const double share = std::clamp((grid.values[i] - scale.lo) / (scale.hi - scale.lo), 0.0, 1.0);
        steps->SetValue(vtkIdType(i), std::isfinite(grid.values[i]) ? static_cast<unsigned short>(1.0 + share * (kSteps - 1.0)) : 0);
    }
    vtkNew<vtkImageData> image;
    image->SetDimensions(g.resolution.x, g.resolution.y, g.resolution.z);
    image->SetSpacing(g.cellSize, g.cellSize, g.cellSize);
    const glm::vec3 first = clvCellCenter(g, ivec3(0));
    image->SetOrigin(first.x, first.y, first.z);
    image->GetPointData()->SetScalars(steps);

    vtkNew<vtkColorTransferFunction> color;
    vtkNew<vtkPiecewiseFunction> opacity;
    constexpr int kKnots = 16;
    for (int k = 0; k <= kKnots; ++k) {
        const double share = double(k) / kKnots, step = 1.0 + share * (kSteps - 1.0);
        const glm::u8vec3 c = scale.color(scale.lo + share * (scale.hi - scale.lo));
        color->AddRGBPoint(step, c.x / 255.0, c.y / 255.0, c.z / 255.0);
        opacity->AddPoint(step, kDensest * share);
    }
    opacity->AddPoint(0.0, 0.0);
    vtkNew<vtkFixedPointVolumeRayCastMapper> mapper;
    mapper->SetInputData(image);
    // Left to itself VTK takes samples 1 m apart at rest and 2 m while the view turns, and trades them for time. The time may cost pixels.
    mapper->SetSampleDistance(kSampleShare * g.cellSize);
    mapper->SetInteractiveSampleDistance(kSampleShare * g.cellSize);
    auto volume = vtkSmartPointer<vtkVolume>::New();
    volume->SetMapper(mapper);
    volume->GetProperty()->SetColor(color);
    volume->GetProperty()->SetScalarOpacity(opacity);
    volume->GetProperty()->SetScalarOpacityUnitDistance(g.cellSize);
    volume->GetProperty()->SetInterpolationTypeToLinear();
    return volume;
}

}  // namespace clv
