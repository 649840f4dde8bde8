#include "benchmarks/report/curves.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "benchmarks/report/statistics.h"
#include "benchmarks/report/text.h"

namespace clv {
namespace {

double workOf(const Measurement& m) {
    return double(m.rays) * m.frames;
}

std::string kindName(const Measurement& m) {
    std::string name = m.method;
    if (settingOf(m, "readers") == "anywhere") name += ", light anywhere";
    if (settingOf(m, "resolution") == "chosen") name += ", resolution chosen";
    return name;
}

template <class NameOf>
std::vector<Curve> groupedBy(std::span<const Measurement> all, const std::string& scene, NameOf&& nameOf) {
    std::vector<Curve> curves;
    for (const Measurement& m : all) {
        if (m.scene != scene) continue;
        const std::string name = nameOf(m);
        auto found = std::ranges::find(curves, name, &Curve::name);
        if (found == curves.end()) found = curves.insert(curves.end(), {name, m.method, {}});
        found->points.push_back(&m);
    }
    for (Curve& curve : curves) std::ranges::stable_sort(curve.points, {}, [](const Measurement* m) { return workOf(*m); });
    return curves;
}

}  // namespace

std::vector<std::string> scenesOf(std::span<const Measurement> all) {
    std::vector<std::string> names;
    for (const Measurement& m : all) {
        if (std::ranges::find(names, m.scene) == names.end()) names.push_back(m.scene);
    }
    return names;
}

std::vector<Curve> curvesOf(std::span<const Measurement> all, const std::string& scene) { return groupedBy(all, scene, curveName); }

std::vector<Curve> kindsOf(std::span<const Measurement> all, const std::string& scene) { return groupedBy(all, scene, kindName); }

CurveLabels::CurveLabels(std::span<const Measurement> all) {
    std::map<std::string, std::size_t> rows;
    std::map<std::pair<std::string, std::string>, std::vector<std::string>> values;
    for (const Measurement& m : all) {
        ++rows[m.method];
        for (const auto& [name, value] : m.settings) values[{m.method, name}].push_back(value);
    }
    for (const auto& [key, found] : values) {
        const auto& [method, name] = key;
        const bool everywhere = found.size() == rows[method], alike = std::ranges::count(found, found.front()) == std::ptrdiff_t(found.size());
        if (!everywhere || !alike) telling_[method].insert(name);
    }
}

std::string CurveLabels::curve(const Measurement& m) const {
    const auto telling = telling_.find(m.method);
    if (telling == telling_.end()) return m.method;
    std::vector<std::string> words;
    for (const auto& [name, value] : m.settings) {
        if (telling->second.contains(name)) words.push_back(name + " " + value);
    }
    return words.empty() ? m.method : fmt::format("{} ({})", m.method, fmt::join(words, ", "));
}

std::string CurveLabels::setting(const Measurement& m) const {
    if (m.raysTraced == 0) return fmt::format("{}, {} frame{}", curve(m), m.frames, m.frames > 1 ? "s" : "");
    const std::string frames = m.frames > 1 ? fmt::format("{} frames of ", m.frames) : "";
    return fmt::format("{}, {}{} rays", curve(m), frames, countText(m.rays));
}

Points pointsOf(std::span<const Curve> curves) {
    Points all;
    for (const Curve& curve : curves) all.insert(all.end(), curve.points.begin(), curve.points.end());
    return all;
}

Points paretoFront(const Points& points, double readers) {
    Points sorted = points, front;
    std::ranges::stable_sort(sorted, {}, [&](const Measurement* m) { return m->seconds(readers); });
    for (const Measurement* m : sorted) {
        if (!std::isfinite(m->seconds(readers))) break;
        if (front.empty() || m->errors.relativeRmse < front.back()->errors.relativeRmse) front.push_back(m);
    }
    return front;
}

const Measurement* bestWithin(const Points& points, double seconds, double readers) {
    const Measurement* best = nullptr;
    for (const Measurement* m : paretoFront(points, readers)) {
        if (m->seconds(readers) <= seconds) best = m;
    }
    return best;
}

std::optional<double> secondsToReach(const Points& points, double error, double readers) {
    const Points front = paretoFront(points, readers);
    const auto reached = std::ranges::find_if(front, [&](const Measurement* m) { return m->errors.relativeRmse <= error; });
    if (reached == front.end()) return {};
    const double after = (*reached)->seconds(readers);
    if (reached == front.begin()) return after;
    const Measurement& before = **(reached - 1);
    const double share = std::log(error / before.errors.relativeRmse) / std::log((*reached)->errors.relativeRmse / before.errors.relativeRmse);
    return before.seconds(readers) * std::pow(after / before.seconds(readers), share);
}

double ErrorFall::at(double work) const {
    return std::hypot(floor, factor * std::pow(work, slope));
}

std::optional<ErrorFall> fitErrorFall(std::span<const double> work, std::span<const double> errors) {
    if (work.size() < 3 || std::ranges::min(work) <= 0.0 || std::ranges::min(errors) <= 0.0) return {};
    const double least = *std::ranges::min_element(errors);
    ErrorFall best;
    double bestMisfit = std::numeric_limits<double>::infinity();
    // For each floor below the least error the rest is a line in logarithms. Of the least square, noise keeps 1 down to 1e-5.
    constexpr int kFloors = 400;
    constexpr double kDecades = 5.0;
    for (int k = 0; k < kFloors; ++k) {
        const double floor = least * std::sqrt(1.0 - std::pow(10.0, -kDecades * k / kFloors));
        std::vector<double> x, y;
        for (std::size_t i = 0; i < work.size(); ++i) {
            x.push_back(std::log(work[i]));
            y.push_back(0.5 * std::log(errors[i] * errors[i] - floor * floor));
        }
        const Line line = fitLine(x, y);
        const ErrorFall fall{floor, std::exp(line.at0), line.slope};
        double misfit = 0.0;
        for (std::size_t i = 0; i < work.size(); ++i) misfit += std::pow(std::log(fall.at(work[i]) / errors[i]), 2.0);
        if (misfit < bestMisfit) bestMisfit = misfit, best = fall;
    }
    return best;
}

}  // namespace clv
