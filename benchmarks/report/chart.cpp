#include "benchmarks/report/chart.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

#include <fmt/format.h>
#include <vtkAxis.h>
#include <vtkChartXY.h>
#include <vtkContext2D.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPlotPoints.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSVGContextDevice2D.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

namespace clv {
namespace {

// Beside the data, in powers of ten.
constexpr double kMargin = 0.15;
// Room that titles and numbers take, pixels.
constexpr int kLeft = 75, kRight = 20, kTop = 35, kBottom = 55;
constexpr int kTitleSize = 15, kTextSize = 12;

bool drawable(const glm::dvec2& p) {
    return p.x > 0.0 && p.y > 0.0 && std::isfinite(p.x) && std::isfinite(p.y);
}

// In decimal logarithms.
struct Range {
    double lo = 0.0, hi = 0.0;
    double length() const { return hi - lo; }
    void widenTo(double length) {
        const double more = std::max(0.0, length - this->length());
        lo -= 0.5 * more, hi += 0.5 * more;
    }
};

Range rangeOf(const Chart& chart, int axis) {
    double lo = 1e300, hi = -1e300;
    for (const ChartSeries& series : chart.series) {
        for (const glm::dvec2& p : series.points) {
            if (drawable(p)) lo = std::min(lo, std::log10(p[axis])), hi = std::max(hi, std::log10(p[axis]));
        }
    }
    return lo <= hi ? Range{lo - kMargin, hi + kMargin} : Range{0.0, 1.0};
}

void setAxis(vtkChartXY& chart, int which, const std::string& title, const Range& range) {
    vtkAxis* axis = chart.GetAxis(which);
    axis->SetTitle(title);
    axis->GetTitleProperties()->SetFontSize(kTextSize);
    axis->GetLabelProperties()->SetFontSize(kTextSize);
    axis->SetLogScale(true);
    axis->SetBehavior(vtkAxis::FIXED);
    axis->SetUnscaledRange(std::pow(10.0, range.lo), std::pow(10.0, range.hi));
}

void addSeries(vtkChartXY& chart, const ChartSeries& series) {
    vtkNew<vtkDoubleArray> x, y;
    x->SetName("x");
    y->SetName("y");
    for (const glm::dvec2& p : series.points) {
        if (drawable(p)) x->InsertNextValue(p.x), y->InsertNextValue(p.y);
    }
    const bool line = series.line && x->GetNumberOfTuples() > 1;
    if (x->GetNumberOfTuples() == 0 || (!line && !series.markers)) return;
    vtkNew<vtkTable> table;
    table->AddColumn(x);
    table->AddColumn(y);
    auto* plot = vtkPlotPoints::SafeDownCast(chart.AddPlot(line ? vtkChart::LINE : vtkChart::POINTS));
    plot->SetInputData(table, 0, 1);
    plot->SetColor(series.color.r, series.color.g, series.color.b, 255);
    plot->SetWidth(series.width);
    // Filled ones: viewers disagree on how lines scale in the others.
    constexpr int kMarkers[] = {vtkPlotPoints::CIRCLE, vtkPlotPoints::SQUARE, vtkPlotPoints::DIAMOND};
    plot->SetMarkerStyle(series.markers ? kMarkers[series.marker % std::size(kMarkers)] : int(vtkPlotPoints::NONE));
    plot->SetMarkerSize(series.markerSize);
}

// VTK writes clipping in pixels for groups that are drawn in units of their own, where it would cut everything off.
void removeClipping(vtkXMLDataElement& element) {
    element.RemoveAttribute("clip-path");
    for (int i = 0; i < element.GetNumberOfNestedElements(); ++i) removeClipping(*element.GetNestedElement(i));
}

}  // namespace

std::string svgOf(const Chart& chart, int width, int height) {
    Range x = rangeOf(chart, 0), y = rangeOf(chart, 1);
    const double across = width - kLeft - kRight, up = height - kTop - kBottom;
    const double decade = std::min(across / x.length(), up / y.length());
    x.widenTo(across / decade);
    y.widenTo(up / decade);

    vtkNew<vtkChartXY> drawn;
    drawn->SetAutoSize(false);
    drawn->SetSize(vtkRectf(0, 0, float(width), float(height)));
    drawn->SetTitle(chart.title);
    drawn->GetTitleProperties()->SetFontSize(kTitleSize);
    setAxis(*drawn, vtkAxis::BOTTOM, chart.xTitle, x);
    setAxis(*drawn, vtkAxis::LEFT, chart.yTitle, y);
    for (const ChartSeries& series : chart.series) addSeries(*drawn, series);
    // Twice: plots learn only while they are drawn first that their axes are logarithmic.
    drawn->Update();
    vtkNew<vtkContextScene> scene;
    scene->AddItem(drawn);
    scene->SetGeometry(width, height);

    vtkNew<vtkXMLDataElement> svg, definitions;
    svg->SetName("svg");
    svg->SetAttribute("xmlns", "http://www.w3.org/2000/svg");
    svg->SetAttribute("xmlns:xlink", "http://www.w3.org/1999/xlink");
    svg->SetAttribute("viewBox", fmt::format("0 0 {} {}", width, height).c_str());
    svg->SetAttribute("width", std::to_string(width).c_str());
    svg->SetAttribute("height", std::to_string(height).c_str());
    svg->SetAttribute("fill", "none");
    svg->SetAttribute("style", "background: white");
    definitions->SetName("defs");
    // Never shown: the device asks it for its size.
    vtkNew<vtkRenderWindow> window;
    vtkNew<vtkRenderer> renderer;
    window->SetOffScreenRendering(1);
    window->SetSize(width, height);
    window->AddRenderer(renderer);
    vtkNew<vtkSVGContextDevice2D> device;
    device->SetSVGContext(svg, definitions);
    device->SetTextAsPath(true);
    vtkNew<vtkContext2D> context;
    device->Begin(renderer);
    context->Begin(device);
    scene->Paint(context);
    context->End();
    device->End();
    device->GenerateDefinitions();
    svg->AddNestedElement(definitions);
    removeClipping(*svg);
    std::ostringstream text;
    vtkIndent indent;
    vtkXMLUtilities::FlattenElement(svg, text, &indent);
    return text.str();
}

glm::u8vec3 chartColor(std::size_t index) {
    // The first six by Okabe and Ito 2008: told apart by colour-blind eyes too.
    constexpr glm::u8vec3 kColors[] = {{213, 94, 0}, {0, 114, 178}, {0, 158, 115}, {204, 121, 167}, {230, 159, 0}, {86, 180, 233}, {90, 90, 90}, {148, 70, 20}, {110, 60, 180}, {120, 150, 20}, {220, 60, 90}, {0, 90, 90}, {0, 0, 0}, {160, 160, 200}};
    return kColors[index % std::size(kColors)];
}

const char* chartMarker(std::size_t index) {
    constexpr const char* kSigns[] = {"●", "■", "◆"};
    return kSigns[index % std::size(kSigns)];
}

}  // namespace clv
