#include "benchmarks/report/goals.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "benchmarks/report/statistics.h"
#include "benchmarks/report/text.h"

namespace clv {
namespace {

// A fixed resolution plans nothing.
bool alikeButForResolution(const Measurement& a, const Measurement& b) {
    return std::ranges::equal(a.settings, b.settings, [](const auto& one, const auto& other) {
        return one.first == "resolution" || one.first == "planned_rays" ? other.first == one.first : one == other;
    });
}

std::string pixelsText(const Measurement& m) {
    return m.wholePicture ? fmt::format(" at {} pixels", settingOf(m, "pixels")) : "";
}

using Filter = std::function<bool(const Measurement&)>;

Points filtered(std::span<const Measurement> all, const std::string& scene, const Filter& filter) {
    Points points;
    for (const Measurement& m : all) {
        if (m.scene == scene && filter(m)) points.push_back(&m);
    }
    return points;
}

Filter method(const std::string& name) {
    return [name](const Measurement& m) { return m.method == name; };
}
Filter withReaders(const std::string& name, const std::string& readers) {
    return [=](const Measurement& m) { return m.method == name && settingOf(m, "readers") == readers; };
}

Verdict verdictOf(bool reached) { return reached ? Verdict::reached : Verdict::missed; }

GoalResult ratioResult(const std::string& goal, const std::string& scene, double ratio, double least, const std::string& where) {
    return {goal, scene, fmt::format("{:.3g}× {}", ratio, where), verdictOf(ratio >= least)};
}

class Judge {
public:
    Judge(std::span<const Measurement> all, const std::string& scene, double pointReaders, double pictureReaders)
        : all_(all), scene_(scene), pointReaders_(pointReaders), pictureReaders_(pictureReaders) {}

    std::vector<GoalResult> judge() {
        onePictureAgainstPathTracing();
        mergedPicturesAgainstPathTracing();
        atEqualError("against DDGI, light for moving objects anywhere: ≥ 8× faster", withReaders(kLibraryName, "anywhere"), withReaders("ddgi", "anywhere"), 8.0);
        atEqualError("against DDGI, only probes near surfaces: ≥ 1.5× faster", withReaders(kLibraryName, "surfaces"), withReaders("ddgi", "surfaces"), 1.5);
        reachesWhatNeverIsReached();
        thesisIsNotOnTheFront();
        fallsAsNoiseDoes();
        finerCellsLowerTheFloor();
        chosenIsAsGoodAsFixed();
        return results_;
    }

private:
    Points points(const Filter& filter) const { return filtered(all_, scene_, filter); }

    void onePictureAgainstPathTracing() {
        constexpr double kLeast = 100.0;
        constexpr std::uint64_t kFrameRays = 64 << 10;
        const Points rival = points(method("path_tracing"));
        std::optional<GoalResult> best;
        double bestRatio = 0.0;
        // Each way to read the light at its own error.
        for (const Measurement* own : points([](const Measurement& m) {
                 return m.method == kLibraryName && m.frames == 1 && m.rays == kFrameRays && settingOf(m, "resolution") == "chosen";
             })) {
            const double error = own->errors.relativeRmse;
            const auto seconds = secondsToReach(rival, error, pictureReaders_);
            if (!seconds || *seconds <= bestRatio * own->seconds(pictureReaders_)) continue;
            bestRatio = *seconds / own->seconds(pictureReaders_);
            best = ratioResult("against path tracing, a picture of 1280 × 720, one frame of 64k rays: ≥ 100× faster", scene_, bestRatio, kLeast,
                               fmt::format("at {}, read by {}{}", percentText(error), settingOf(*own, "lookup"), pixelsText(*own)));
        }
        if (best) results_.push_back(*best);
    }

    void mergedPicturesAgainstPathTracing() {
        constexpr double kLeast = 500.0;
        constexpr std::pair<const char*, double> kErrors[] = {{"cornell", 0.07}, {"atrium", 0.17}};
        for (const auto& [name, error] : kErrors) {
            if (scene_ != name) continue;
            const auto own = secondsToReach(points(method(kLibraryName)), error, pictureReaders_), rival = secondsToReach(points(method("path_tracing")), error, pictureReaders_);
            const std::string goal = "against path tracing, a picture of a still scene, merged frames: ≥ 500× faster", where = fmt::format("at {}", percentText(error));
            if (own && rival) results_.push_back(ratioResult(goal, scene_, *rival / *own, kLeast, where));
            if (!own && rival) results_.push_back({goal, scene_, "never " + where, Verdict::missed});
            if (!rival && !points(method("path_tracing")).empty()) results_.push_back({goal, scene_, fmt::format("path tracing has too few rays for {}", percentText(error)), Verdict::open});
        }
    }

    // Over the rival's front, the median of how much longer it takes.
    void atEqualError(const std::string& goal, const Filter& own, const Filter& rival, double least) {
        const Points ownPoints = points(own), rivalPoints = points(rival);
        if (ownPoints.empty() || rivalPoints.empty()) return;
        std::vector<double> ratios;
        for (const Measurement* m : paretoFront(rivalPoints, pointReaders_)) {
            const auto seconds = secondsToReach(ownPoints, m->errors.relativeRmse, pointReaders_);
            ratios.push_back(seconds ? m->seconds(pointReaders_) / *seconds : 0.0);
        }
        results_.push_back(ratioResult(goal, scene_, median(ratios), least, fmt::format("median, {:.3g} to {:.3g}×", std::ranges::min(ratios), std::ranges::max(ratios))));
    }

    void reachesWhatNeverIsReached() {
        const Points own = paretoFront(points(method(kLibraryName)), pointReaders_), rival = paretoFront(points(method("light_propagation")), pointReaders_);
        if (own.empty() || rival.empty()) return;
        const double least = own.back()->errors.relativeRmse, theirs = rival.back()->errors.relativeRmse;
        results_.push_back({"against light propagation volumes: reaches errors that they never reach", scene_,
                            fmt::format("{} against {}", percentText(least), percentText(theirs)), verdictOf(least < theirs)});
    }

    void thesisIsNotOnTheFront() {
        if (points(method("thesis")).empty()) return;
        const auto count = std::ranges::count(paretoFront(points([](const Measurement&) { return true; }), pointReaders_), "thesis", &Measurement::method);
        results_.push_back({"the thesis' rule: no setting of it lies on the Pareto front", scene_, fmt::format("{} of them", count), verdictOf(count == 0)});
    }

    struct Fall : ErrorFall {
        bool floorShows = false;  // the most rays leave less noise than floor
    };
    // Of the curve that goes on to the most rays.
    std::optional<Fall> fallOf(const std::string& resolution) const {
        Curve longest;
        std::uint64_t mostRays = 0;
        for (const Curve& curve : curvesOf(all_, scene_)) {
            const Measurement& m = *curve.points.front();
            const bool fits = m.method == kLibraryName && !m.wholePicture && settingOf(m, "resolution") == resolution && settingOf(m, "storage") == "cube9" && settingOf(m, "readers") == "surfaces";
            if (!fits) continue;
            for (const Measurement* point : curve.points) {
                if (point->raysTraced > mostRays) mostRays = point->raysTraced, longest = curve;
            }
        }
        std::vector<double> rays, errors;
        for (const Measurement* m : longest.points) rays.push_back(double(m->raysTraced)), errors.push_back(m->errors.relativeRmse);
        const auto fall = fitErrorFall(rays, errors);
        if (!fall) return {};
        return Fall{*fall, fall->at(std::ranges::max(rays)) < std::sqrt(2.0) * fall->floor};
    }
    void fallsAsNoiseDoes() {
        constexpr double kSlope = -0.5;
        if (const auto fall = fallOf("32")) results_.push_back({"error over rays at 32³, floor apart: slope of −0.5 or steeper", scene_, fmt::format("{:.3f}", fall->slope), verdictOf(fall->slope <= kSlope)});
    }
    void finerCellsLowerTheFloor() {
        constexpr double kLeast = 1.3;
        const auto coarse = fallOf("32"), fine = fallOf("64");
        if (!coarse || !fine) return;
        const std::string goal = "the floor falls from 32³ to 64³ by ≥ 1.3";
        if (coarse->floorShows && fine->floorShows)
            results_.push_back(ratioResult(goal, scene_, coarse->floor / fine->floor, kLeast, fmt::format("({} to {})", percentText(coarse->floor), percentText(fine->floor))));
        else
            results_.push_back({goal, scene_, "noise still hides the floor: too few rays", Verdict::open});
    }

    void chosenIsAsGoodAsFixed() {
        constexpr double kMost = 1.03;
        double worst = 0.0;
        for (const Measurement* chosen : points([](const Measurement& m) { return m.method == kLibraryName && settingOf(m, "resolution") == "chosen"; })) {
            for (const Measurement* fixed : points(method(kLibraryName))) {
                // Each frame has maps of its own, so that more frames of fewer rays are another measurement.
                if (settingOf(*fixed, "resolution") == "chosen" || !alikeButForResolution(*fixed, *chosen) || fixed->rays != chosen->rays || fixed->frames != chosen->frames) continue;
                worst = std::max(worst, chosen->errors.relativeRmse / fixed->errors.relativeRmse);
            }
        }
        if (worst > 0.0) results_.push_back({"the chosen resolution errs at most 1.03 times as much as any fixed one with the same rays in as many frames", scene_, fmt::format("{:.3f} at worst", worst), verdictOf(worst <= kMost)});
    }

    const std::span<const Measurement> all_;
    const std::string scene_;
    const double pointReaders_, pictureReaders_;
    std::vector<GoalResult> results_;
};

}  // namespace

std::vector<GoalResult> judgeGoals(std::span<const Measurement> all, double pointReaders, double pictureReaders) {
    std::vector<GoalResult> results;
    for (const std::string& scene : scenesOf(all)) {
        for (const GoalResult& result : Judge(all, scene, pointReaders, pictureReaders).judge()) results.push_back(result);
    }
    // The same goal in all scenes stands together.
    std::vector<std::string> order;
    for (const GoalResult& result : results) {
        if (std::ranges::find(order, result.goal) == order.end()) order.push_back(result.goal);
    }
    std::ranges::stable_sort(results, {}, [&](const GoalResult& result) { return std::ranges::find(order, result.goal) - order.begin(); });
    return results;
}

}  // namespace clv
