// Whether the resolution that the library chooses errs as little as the best fixed one, on built-in scenes and on generated ones.
#include <algorithm>
#include <cmath>
#include <map>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "benchmarks/measured_scene.h"
#include "bindings/embree/task_pool.h"
#include "bindings/scene/generated_scene.h"
#include "clv/cpu/resolution.h"

namespace {

using namespace clv;

constexpr int kChosen = 0;  // the resolution that LightOptions takes for the library's own choice

struct Settings {
    std::vector<std::string> scenes = {"cornell", "two_rooms", "corridor", "atrium", "atrium_turned", "furnace_box", "white_sphere"};
    int generated = 10, firstSeed = 1;
    std::vector<std::uint64_t> rays = {16 << 10, 64 << 10, 256 << 10, 1 << 20, 4 << 20};
    std::size_t points = 1000;
    std::uint64_t truthSamples = 16384;
    int seeds = 8;
    int threads = 0;
};

struct Outcome {
    double error = 0.0;    // relative RMSE, quadratic mean over the seeds
    double seconds = 0.0;  // of a run's frames, median over the seeds
    std::map<std::string, int> shown;  // levels that were shown, and in how many of the runs
};

// The grid is shifted from seed to seed.
Outcome measure(const MeasuredScene& scene, int resolution, std::uint64_t rays, const Settings& settings, const ParallelFor& parallelFor) {
    Outcome outcome;
    std::vector<double> seconds;
    double square = 0.0;
    for (int k = 0; k < settings.seeds; ++k) {
        LightOptions options;
        options.resolution = resolution;
        options.rays = rays;
        options.cellShift = cellShift(k);
        const MeasuredLight light = measureLight(scene, options, 100 + std::uint32_t(k), parallelFor);
        square += light.errors.relativeRmse * light.errors.relativeRmse;
        seconds.push_back(light.report.frameSeconds);
        std::string levels;
        for (const auto& [level, weight] : light.report.levels) levels += fmt::format("{}{}", levels.empty() ? "" : "+", level);
        ++outcome.shown[levels];
    }
    outcome.error = std::sqrt(square / settings.seeds);
    outcome.seconds = median(seconds);
    return outcome;
}

nlohmann::ordered_json compare(const MeasuredScene& scene, std::uint64_t rays, const Settings& settings, const ParallelFor& parallelFor) {
    nlohmann::ordered_json row = {{"scene", scene.scene.name}, {"rays", rays}};
    Outcome best;
    int bestResolution = 0;
    std::string line = fmt::format("{:14} {:>8}", scene.scene.name, rays);
    for (const int resolution : kResolutions) {
        const Outcome fixed = measure(scene, resolution, rays, settings, parallelFor);
        if (bestResolution == 0 || fixed.error < best.error) best = fixed, bestResolution = resolution;
        row["fixed"][std::to_string(resolution)] = {{"relative_rmse", fixed.error}, {"frame_ms", 1e3 * fixed.seconds}};
        line += fmt::format(" {:6.2f} %", 100.0 * fixed.error);
    }
    const Outcome chosen = measure(scene, kChosen, rays, settings, parallelFor);
    const double ratio = relativeTo(chosen.error, best.error), timeRatio = relativeTo(chosen.seconds, best.seconds);
    row["chosen"] = {{"relative_rmse", chosen.error}, {"frame_ms", 1e3 * chosen.seconds}, {"levels", chosen.shown}};
    row["best_fixed"] = bestResolution;
    row["error_ratio"] = ratio;
    row["time_ratio"] = timeRatio;
    std::string shown;
    for (const auto& [levels, count] : chosen.shown) shown += fmt::format(" {}x{}", count, levels);
    fmt::print(stderr, "{} | chosen {:6.2f} %, {:.3f} of the best fixed, {:.2f} of its time |{}\n", line, 100.0 * chosen.error, ratio, timeRatio, shown);
    return row;
}

}  // namespace

int main(int argc, char** argv) {
    Settings settings;
    CLI::App app("The chosen resolution against fixed ones");
    app.add_option("--scenes", settings.scenes, "Built-in scenes or files")->expected(0, -1)->capture_default_str();
    app.add_option("--generated", settings.generated, "Generated scenes, how many")->capture_default_str();
    app.add_option("--first-seed", settings.firstSeed, "Seed of the first generated scene")->capture_default_str();
    app.add_option("--rays", settings.rays, "Rays of a run, one or more counts")->capture_default_str();
    app.add_option("--points", settings.points, "Points that the cameras see")->capture_default_str();
    app.add_option("--truth-samples", settings.truthSamples, "Paths a point")->capture_default_str();
    app.add_option("--seeds", settings.seeds, "Runs a figure, each with a shift of the grid of its own")->capture_default_str();
    app.add_option("--threads", settings.threads, "0: all")->capture_default_str();
    CLI11_PARSE(app, argc, argv);

    const ParallelFor parallelFor = tbbParallelFor(settings.threads);
    std::vector<Scene> scenes;
    for (const std::string& name : settings.scenes) scenes.push_back(loadScene(name));
    for (int k = 0; k < settings.generated; ++k) scenes.push_back(makeGeneratedScene(std::uint32_t(settings.firstSeed + k)));
    nlohmann::ordered_json report = nlohmann::ordered_json::array();
    for (Scene& scene : scenes) {
        const MeasuredScene measured = measureScene(std::move(scene), settings.points, settings.truthSamples, parallelFor);
        for (const std::uint64_t rays : settings.rays) {
            report.push_back(compare(measured, rays, settings, parallelFor));
            report.back()["points"] = measured.points.size();
            report.back()["truth_standard_error"] = measured.truthError;
        }
    }
    fmt::print("{}\n", report.dump(2));
}
