#include "viz/flat_actors.h"

#include <algorithm>
#include <numeric>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>

namespace clv {
namespace {

constexpr double kInFront = -66000.0;  // units of depth that bring lines before all else

vtkNew<vtkPolyData> polyDataOf(std::span<const glm::vec3> positions) {
    vtkNew<vtkFloatArray> coordinates;
    coordinates->SetNumberOfComponents(3);
    coordinates->SetNumberOfTuples(vtkIdType(positions.size()));
    std::copy_n(reinterpret_cast<const float*>(positions.data()), 3 * positions.size(), coordinates->GetPointer(0));
    vtkNew<vtkPoints> points;
    points->SetData(coordinates);
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    return data;
}

vtkNew<vtkUnsignedCharArray> arrayOf(std::span<const glm::u8vec3> colors) {
    vtkNew<vtkUnsignedCharArray> array;
    array->SetNumberOfComponents(3);
    array->SetNumberOfTuples(vtkIdType(colors.size()));
    std::copy_n(reinterpret_cast<const unsigned char*>(colors.data()), 3 * colors.size(), array->GetPointer(0));
    return array;
}

// Cells of `corners` points each, one after the other.
vtkNew<vtkCellArray> runs(std::size_t points, int corners) {
    vtkNew<vtkTypeInt32Array> offsets, ids;
    offsets->SetNumberOfValues(vtkIdType(points) / corners + 1);
    ids->SetNumberOfValues(vtkIdType(points));
    for (vtkIdType cell = 0; cell < offsets->GetNumberOfValues(); ++cell) offsets->SetValue(cell, int(cell) * corners);
    std::iota(ids->Begin(), ids->End(), 0);
    vtkNew<vtkCellArray> cells;
    cells->SetData(offsets, ids);
    return cells;
}

vtkSmartPointer<vtkActor> actorOf(vtkPolyData* data) {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(data);
    mapper->StaticOn();
    auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    actor->GetProperty()->LightingOff();
    return actor;
}

}  // namespace

vtkSmartPointer<vtkActor> actorOf(const FlatQuads& quads) {
    const auto data = polyDataOf(quads.points);
    data->SetPolys(runs(quads.points.size(), 4));
    data->GetCellData()->SetScalars(arrayOf(quads.colors));
    const auto actor = actorOf(data);
    actor->GetProperty()->SetBackfaceCulling(quads.oneSided);
    return actor;
}

vtkSmartPointer<vtkActor> actorOf(const FlatTriangles& triangles) {
    const auto data = polyDataOf(triangles.points);
    vtkNew<vtkCellArray> cells;
    cells->Use32BitStorage();
    cells->AllocateExact(vtkIdType(triangles.corners.size()), vtkIdType(3 * triangles.corners.size()));
    for (const glm::uvec3& c : triangles.corners) {
        const vtkIdType ids[] = {vtkIdType(c.x), vtkIdType(c.y), vtkIdType(c.z)};
        cells->InsertNextCell(3, ids);
    }
    data->SetPolys(cells);
    data->GetPointData()->SetScalars(arrayOf(triangles.colors));
    const auto actor = actorOf(data);
    actor->GetProperty()->BackfaceCullingOn();
    return actor;
}

vtkSmartPointer<vtkActor> actorOf(const FlatLines& lines) {
    const auto data = polyDataOf(lines.points);
    data->SetLines(runs(lines.points.size(), 2));
    data->GetCellData()->SetScalars(arrayOf(lines.colors));
    const auto actor = actorOf(data);
    actor->GetProperty()->SetLineWidth(lines.width);
    if (lines.inFront) {
        actor->GetMapper()->SetResolveCoincidentTopologyToPolygonOffset();
        actor->GetMapper()->SetRelativeCoincidentTopologyLineOffsetParameters(0.0, kInFront);
    }
    return actor;
}

vtkSmartPointer<vtkActor> actorOf(const FlatPoints& points) {
    const auto data = polyDataOf(points.points);
    data->SetVerts(runs(points.points.size(), 1));
    data->GetPointData()->SetScalars(arrayOf(points.colors));
    const auto actor = actorOf(data);
    actor->GetProperty()->SetPointSize(points.size);
    return actor;
}

}  // namespace clv
