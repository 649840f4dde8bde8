#include "benchmarks/report/page.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "benchmarks/report/chart.h"
#include "benchmarks/report/goals.h"
#include "benchmarks/report/text.h"

namespace clv {
namespace {

constexpr int kPlotWidth = 620, kNarrowPlotWidth = 420, kPlotHeight = 420;
// Run times of a frame, s.
constexpr double kPointBudgets[] = {0.5e-3, 1e-3, 2e-3, 5e-3, 10e-3, 50e-3};
constexpr double kPictureBudgets[] = {50e-3, 100e-3, 200e-3, 500e-3, 1.0, 5.0};

constexpr const char* kStyle = R"(
body { font: 15px/1.45 sans-serif; margin: 2em auto; max-width: 1300px; padding: 0 1em; color: #222; }
table { border-collapse: collapse; margin: 0.7em 0 1.5em; }
td:first-child, .plots td { white-space: nowrap; }
th, td { border-bottom: 1px solid #ddd; padding: 0.25em 0.8em; text-align: left; vertical-align: top; }
th { border-bottom: 2px solid #888; }
small, .note { color: #666; }
.plots { display: flex; flex-wrap: wrap; gap: 1em; }
figure { margin: 0; max-width: 640px; } figcaption { font-size: 90%; color: #444; }
.maps figure { max-width: 400px; }
.key span { white-space: nowrap; margin-right: 1.3em; }
.missed { color: #b00; }
.wide { overflow-x: auto; font-size: 85%; }
)";

std::string row(const std::vector<std::string>& cells, const char* tag = "td") {
    std::string text = "<tr>";
    for (const std::string& cell : cells) text += fmt::format("<{0}>{1}</{0}>", tag, cell);
    return text + "</tr>\n";
}

// For each budget and scene the setting that errs least within it.
std::string budgetTable(const std::vector<Measurement>& all, const CurveLabels& labels, std::span<const double> budgets, double readers) {
    const std::vector<std::string> scenes = scenesOf(all);
    std::vector<std::string> head = {"budget"};
    for (const std::string& scene : scenes) head.push_back(escaped(scene));
    std::string text = "<table>\n" + row(head, "th");
    for (const double budget : budgets) {
        std::vector<std::string> cells = {fmt::format("<b>{:g} ms</b>", 1e3 * budget)};
        for (const std::string& scene : scenes) {
            const Measurement* best = bestWithin(pointsOf(curvesOf(all, scene)), budget, readers);
            cells.push_back(best ? fmt::format("<b>{}</b> {}<br><small>{}</small>", percentText(best->errors.relativeRmse), escaped(labels.setting(*best)),
                                               timeText(best->seconds(readers)))
                                 : "–");
        }
        text += row(cells);
    }
    return text + "</table>\n";
}

std::string figure(const Chart& chart, const std::string& caption, int width = kPlotWidth) {
    return fmt::format("<figure style=\"width:{}px\">{}<figcaption>{}</figcaption></figure>\n", width, svgOf(chart, width, kPlotHeight), caption);
}

template <class X, class Y>
Chart curveChart(const std::vector<Curve>& curves, X&& x, Y&& y) {
    Chart chart;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        ChartSeries series{.points = {}, .color = chartColor(i), .marker = i};
        for (const Measurement* m : curves[i].points) series.points.emplace_back(x(*m), y(*m));
        chart.series.push_back(series);
    }
    return chart;
}

double errorPercent(const Measurement& m) {
    return 100.0 * m.errors.relativeRmse;
}

// A curve a kind of method, through the best of its settings; the others are small and pale.
std::string errorOverTime(const std::vector<Curve>& kinds, double readers, const std::string& title) {
    const auto milliseconds = [&](const Measurement& m) { return 1e3 * m.seconds(readers); };
    Chart chart = curveChart(kinds, milliseconds, errorPercent);
    for (ChartSeries& settings : chart.series) {
        settings.line = false, settings.markerSize = 4.0f;
        settings.color = glm::u8vec3((glm::vec3(settings.color) + 2.0f * 255.0f) / 3.0f);
    }
    const auto addFront = [&](const Points& points, ChartSeries line) {
        for (const Measurement* m : paretoFront(points, readers)) line.points.emplace_back(milliseconds(*m), errorPercent(*m));
        chart.series.push_back(line);
    };
    addFront(pointsOf(kinds), {.points = {}, .color = glm::u8vec3(190), .markers = false, .width = 9.0f});
    for (std::size_t i = 0; i < kinds.size(); ++i) addFront(kinds[i].points, {.points = {}, .color = chartColor(i), .marker = i});
    chart.title = title, chart.xTitle = "run time, ms", chart.yTitle = "relative RMSE, %";
    return figure(chart, "Lower and further left is better. A curve is a method at the best of its settings; small and pale: the others. Grey: the Pareto front, which nothing beats in both.");
}

std::string errorOverRays(const std::vector<Curve>& curves, const CurveLabels& labels) {
    const auto work = [](const Measurement& m) { return double(m.raysTraced); };
    Chart chart = curveChart(curves, work, errorPercent);
    chart.title = "error over rays", chart.xTitle = "rays traced, all frames", chart.yTitle = "relative RMSE, %";
    std::string table = "<table>" + row({"", "slope", "floor"}, "th");
    for (std::size_t i = 0; i < curves.size(); ++i) {
        std::vector<double> rays, errors;
        for (const Measurement* m : curves[i].points) rays.push_back(work(*m)), errors.push_back(m->errors.relativeRmse);
        const auto fall = fitErrorFall(rays, errors);
        if (!fall) continue;  // too few measurements, or no rays
        ChartSeries fitted{.points = {}, .color = chartColor(i), .markers = false, .width = 1.0f};
        const auto [least, most] = std::ranges::minmax(rays);
        constexpr int kSteps = 32;
        for (int k = 0; k <= kSteps; ++k) {
            const double n = least * std::pow(most / least, double(k) / kSteps);
            fitted.points.emplace_back(n, 100.0 * fall->at(n));
        }
        chart.series[i].line = false;
        chart.series.push_back(fitted);
        table += row({escaped(labels.curve(*curves[i].points.front())), fmt::format("{:.2f}", fall->slope), percentText(fall->floor)});
    }
    return figure(chart, "Thin: error² = floor² + (c · rays^slope)². Noise alone falls with a slope of −0.5; the floor is what no rays remove." + table + "</table>");
}

std::string bytesOverError(const std::vector<Curve>& curves) {
    Chart chart = curveChart(curves, errorPercent, [](const Measurement& m) { return double(m.bytes) / double(1 << 20); });
    chart.title = "memory over error", chart.xTitle = "relative RMSE, %", chart.yTitle = "MiB held";
    return figure(chart, "For the light and for finding it, without the scene.", kNarrowPlotWidth);
}

template <class NameOf>
std::string keyOf(const std::vector<Curve>& curves, NameOf&& nameOf) {
    std::string text = "<p class=\"key\">";
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const glm::u8vec3 c = chartColor(i);
        text += fmt::format("<span><b style=\"color:#{:02x}{:02x}{:02x}\">{}</b> {}</span> ", c.r, c.g, c.b, chartMarker(i), escaped(nameOf(curves[i])));
    }
    return text + "</p>\n";
}

const char* verdictCell(Verdict verdict) {
    switch (verdict) {
        case Verdict::reached: return "reached";
        case Verdict::missed: return "<b class=\"missed\">missed</b>";
        case Verdict::open: return "not told";
    }
    return "";
}

std::string goalTable(const std::vector<Measurement>& all) {
    std::string text = "<table>" + row({"goal", "scene", "measured", ""}, "th");
    for (const GoalResult& result : judgeGoals(all, kPointReaders, kPictureReaders))
        text += row({escaped(result.goal), escaped(result.scene), escaped(result.measured), verdictCell(result.verdict)});
    return text + "</table>\n";
}

std::string nanosecondsText(double nanoseconds) { return nanoseconds < 100.0 ? fmt::format("{:.1f}", nanoseconds) : groupedText(nanoseconds); }

// A column of each scene: ns an item, and what it is of the machine's limit.
std::string stageTable(const std::vector<SceneStages>& all) {
    std::vector<std::string> head = {"stage", "an item is a", "limit"};
    std::vector<std::string> names;
    for (const SceneStages& stages : all) {
        head.insert(head.end(), {escaped(stages.scene) + ", ns an item", "bytes", "of the limit"});
        for (const StageTime& time : stages.times) {
            if (std::ranges::find(names, time.stage) == names.end()) names.push_back(time.stage);
        }
    }
    std::string text = "<table>\n" + row(head, "th");
    for (const std::string& name : names) {
        std::vector<std::string> cells = {escaped(name), "", ""};
        for (const SceneStages& stages : all) {
            const auto time = std::ranges::find(stages.times, name, &StageTime::stage);
            if (time == stages.times.end()) {
                cells.insert(cells.end(), {"–", "", ""});
                continue;
            }
            cells[1] = escaped(time->item), cells[2] = escaped(time->limit);
            cells.insert(cells.end(), {fmt::format("{} <small>± {}</small>", nanosecondsText(time->nanoseconds), nanosecondsText(0.5 * time->spread)), fmt::format("{:.0f}", time->bytes),
                                       fmt::format("{:.0f} %", 100.0 * time->share)});
        }
        text += row(cells);
    }
    return text + "</table>\n";
}

std::string aboutTable(const nlohmann::ordered_json& about) {
    std::string text;
    for (const auto& [name, value] : about.items()) text += row({escaped(name), escaped(value.is_string() ? value.get<std::string>() : value.dump())});
    return "<table>\n" + text + "</table>\n";
}

std::string fullTable(const std::vector<Measurement>& all) {
    std::string text = "<div class=\"wide\"><table>" +
                       row({"scene", "method", "rays", "frames", "relative RMSE", "± 95 %", "bias", "p95", "leak", "RMS", "PSNR", "look different", "maps", "frames' time",
                            "spread", "lookups", fmt::format("at {} points", groupedText(kPointReaders)), fmt::format("at {} pixels", groupedText(kPictureReaders)), "set-up", "rays traced", "held"},
                           "th");
    for (const Measurement& m : all) {
        text += row({escaped(m.scene), escaped(curveName(m)), countText(m.rays), std::to_string(m.frames), percentText(m.errors.relativeRmse), percentText(m.errorInterval),
                     percentText(m.errors.bias), percentText(m.errors.p95), m.leak ? fmt::format("{:.2f}", *m.leak) : "", fmt::format("{:.4f}", m.picture.rms),
                     fmt::format("{:.1f} dB", m.picture.psnr), percentText(m.picture.perceptualFailures), timeText(m.mapSeconds), timeText(m.frameSeconds),
                     timeText(m.frameSecondsSpread), timeText(m.lookupSeconds), timeText(m.seconds(kPointReaders)), timeText(m.seconds(kPictureReaders)),
                     timeText(m.setupSeconds), fmt::format("{}", m.raysTraced), bytesText(m.bytes)});
    }
    return text + "</table></div>\n";
}

}  // namespace

std::string htmlOf(const std::vector<Measurement>& all, const nlohmann::ordered_json& about, const std::map<std::string, std::vector<HeatMap>>& heatMaps,
                   const std::vector<SceneStages>& stages) {
    const CurveLabels labels(all);
    std::string page = fmt::format("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Error against run time</title>\n<style>{}</style></head><body>\n", kStyle);
    page += "<h1>Error against run time</h1>\n<h2>What a millisecond buys</h2>\n";
    page += fmt::format("<p>The setting that errs least within a budget of run time, light and lookups at {} points, maps and set-up apart. "
                        "Errors are relative RMSE of the indirect irradiance against path tracing.</p>\n",
                        groupedText(kPointReaders));
    page += budgetTable(all, labels, kPointBudgets, kPointReaders);
    page += fmt::format("<p>The same at {} points, a picture of {} × {}:</p>\n", groupedText(kPictureReaders), kPictureWidth, kPictureHeight);
    page += budgetTable(all, labels, kPictureBudgets, kPictureReaders);
    page += "<h2>Goals</h2>\n" + goalTable(all) + "<h2>Where this comes from</h2>\n" + aboutTable(about);
    for (const std::string& scene : scenesOf(all)) {
        const std::vector<Curve> curves = curvesOf(all, scene);
        const std::vector<Curve> kinds = kindsOf(all, scene);
        page += fmt::format("<h2>{}</h2>\n{}<div class=\"plots\">\n", escaped(scene), keyOf(kinds, [](const Curve& kind) { return kind.name; }));
        page += errorOverTime(kinds, kPointReaders, fmt::format("{}, {} points", scene, groupedText(kPointReaders)));
        page += errorOverTime(kinds, kPictureReaders, fmt::format("{}, {} x {} pixels", scene, kPictureWidth, kPictureHeight));
        page += fmt::format("</div>\n<p>A curve a setting:</p>\n{}<div class=\"plots\">\n", keyOf(curves, [&](const Curve& curve) { return labels.curve(*curve.points.front()); }));
        page += errorOverRays(curves, labels) + bytesOverError(curves) + "</div>\n";
        page += fmt::format("<p class=\"note\">The truth's own standard error, {}, is in these errors.</p>\n", percentText(curves.front().points.front()->truthError));
        const auto maps = heatMaps.find(scene);
        if (maps == heatMaps.end()) continue;
        page += fmt::format("<h3>Where the methods err within {}</h3>\n<div class=\"plots maps\">\n", timeText(kHeatMapBudget));
        for (const HeatMap& map : maps->second)
            page += fmt::format("<figure><img alt=\"\" src=\"data:image/png;base64,{}\"><figcaption>{}</figcaption></figure>\n", base64(map.png), escaped(map.title));
        page += "</div>\n";
    }
    page += "<h2>What each stage takes</h2>\n<p>On one thread, 16,384 rays, median and half of what the middle half of the turns spans. Limits of the machine are measured in turns with the "
            "stage: a copy of as many bytes, the same additions without the walk, or the same rays in bare Embree, one by one. How times grow with rays, resolution, "
            "threads, cascades and triangles: <code>clv_benchmark_stages</code>.</p>\n" +
            stageTable(stages);
    page += "<h2>All measurements</h2>\n" + fullTable(all);
    return page + "</body></html>\n";
}

}  // namespace clv
