#include "viz/plot_actor.h"

#include <vtkAxis.h>
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

constexpr float kShare = 0.38f, kPlotBarRoom = 0.16f;  // of the part of the window: the inset, and the colour bar right of it
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
    chart->GetBackgroundBrush()->SetColorF(0.05, 0.05, 0.06, 0.85);
    chart->SetAutoSize(false);
    chart->SetSize(vtkRectf((1.0f - kShare - kPlotBarRoom) * float(width), 0.02f * float(height), kShare * float(width), kShare * float(height)));
    auto actor = vtkSmartPointer<vtkContextActor>::New();
    actor->GetScene()->AddItem(chart);
    return actor;
}

}  // namespace clv
