#include "viz/plot_actor.h"

#include <vtkAxis.h>
#include <vtkBlockItem.h>
#include <vtkBrush.h>
#include <vtkChartXY.h>
#include <vtkContextScene.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkPlot.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

namespace clv {
namespace {

// Of the part of the window: the inset, what stays free below it for the status, and the colour bar right of it.
constexpr float kShare = 0.38f, kPlotBottom = 0.05f, kPlotBarRoom = 0.21f;
constexpr int kPlotTextSize = 11;

void setPlotText(vtkTextProperty& text) {
    text.SetFontSize(kPlotTextSize);
    text.SetColor(0.92, 0.92, 0.92);
    text.BoldOff();
}

void setAxis(vtkAxis& axis, const std::string& title) {
    axis.SetTitle(title);
    axis.GetPen()->SetColorF(0.92, 0.92, 0.92);
    axis.GetGridPen()->SetColorF(0.3, 0.3, 0.3);
    setPlotText(*axis.GetTitleProperties());
    setPlotText(*axis.GetLabelProperties());
}

}  // namespace

vtkSmartPointer<vtkContextActor> actorOf(const Plot& plot, int width, int height) {
    vtkNew<vtkFloatArray> x, y;
    x->SetName("x");
    y->SetName("y");
    for (const glm::dvec2& p : plot.points) x->InsertNextValue(float(p.x)), y->InsertNextValue(float(p.y));
    vtkNew<vtkTable> table;
    table->AddColumn(x);
    table->AddColumn(y);
    vtkNew<vtkChartXY> chart;
    if (!plot.points.empty()) {
        vtkPlot* const line = chart->AddPlot(plot.bars ? vtkChart::BAR : vtkChart::LINE);
        line->SetInputData(table, 0, 1);
        line->SetColor(120, 190, 255, 255);
    }
    chart->SetTitle(plot.title);
    setPlotText(*chart->GetTitleProperties());
    setAxis(*chart->GetAxis(vtkAxis::BOTTOM), plot.xTitle);
    setAxis(*chart->GetAxis(vtkAxis::LEFT), plot.yTitle);
    chart->SetAutoSize(false);
    const vtkRectf place((1.0f - kShare - kPlotBarRoom) * float(width), kPlotBottom * float(height), kShare * float(width), kShare * float(height));
    chart->SetSize(place);
    // A chart's own background begins at the corner of the axes.
    vtkNew<vtkBlockItem> backing;
    backing->SetDimensions(place.GetData());
    backing->GetBrush()->SetColorF(0.05, 0.05, 0.06, 0.85);
    backing->GetPen()->SetLineType(vtkPen::NO_PEN);
    auto actor = vtkSmartPointer<vtkContextActor>::New();
    actor->GetScene()->AddItem(backing);
    actor->GetScene()->AddItem(chart);
    return actor;
}

}  // namespace clv
