// Error of the light volume on the built-in scenes, against the path tracer, and the time of a frame: the table of docs/accuracy.md.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "benchmarks/measured_scene.h"
#include "bindings/embree/task_pool.h"

namespace {

using namespace clv;

struct Settings {
    std::vector<std::string> scenes = {"cornell", "two_rooms", "atrium", "atrium_turned"};
    std::size_t points = 3000;
    std::uint64_t truthSamples = 65536, convergedRays = 32u << 20, frameRays = 64u << 10;
    int shifts = 8, seeds = 8;
    int threads = 0;
    bool skipConverged = false;
};

// Mean irradiance of the points that lie in the dark room of two_rooms.
double darkRoomMean(const MeasuredScene& c, const std::vector<glm::vec3>& values) {
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (c.points[i].position.x < 5.27f) continue;
        sum += values[i].x + values[i].y + values[i].z, ++count;
    }
    return count > 0 ? sum / (3.0 * count) : 0.0;
}

nlohmann::ordered_json converged(const MeasuredScene& c, int resolution, const Settings& settings, const ParallelFor& parallelFor) {
    double rmse = 0.0, bias = 0.0, worstLeak = 0.0;
    for (int k = 0; k < settings.shifts; ++k) {
        LightOptions options;
        options.resolution = resolution;
        options.rays = settings.convergedRays;
        options.cellShift = cellShift(k);
        const MeasuredLight light = measureLight(c, options, 1 + std::uint32_t(k), parallelFor);
        rmse += light.errors.relativeRmse / settings.shifts, bias += light.errors.bias / settings.shifts;
        if (c.scene.name == "two_rooms") worstLeak = std::max(worstLeak, darkRoomMean(c, light.irradiance) / darkRoomMean(c, c.truth));
    }
    nlohmann::ordered_json row = {{"resolution", resolution}, {"relative_rmse", rmse}, {"bias", bias}};
    if (worstLeak > 0.0) row["worst_leak"] = worstLeak;
    return row;
}

// One frame: levels chosen by the library; the first run only warms up.
nlohmann::ordered_json oneFrame(const MeasuredScene& c, const Settings& settings, const ParallelFor& parallelFor) {
    std::vector<double> milliseconds;
    std::vector<std::pair<std::string, std::vector<double>>> stages;
    double square = 0.0;
    for (int k = 0; k <= settings.seeds; ++k) {
        LightOptions options;
        options.rays = settings.frameRays;
        options.cellShift = cellShift(k);
        const MeasuredLight light = measureLight(c, options, 100 + std::uint32_t(k), parallelFor);
        if (k == 0) continue;
        milliseconds.push_back(1e3 * light.report.frameSeconds);
        for (const auto& [name, seconds] : light.report.stages) {
            auto found = std::find_if(stages.begin(), stages.end(), [&, &key = name](const auto& s) { return s.first == key; });
            if (found == stages.end()) found = stages.insert(stages.end(), {name, {}});
            found->second.push_back(1e3 * seconds);
        }
        square += light.errors.relativeRmse * light.errors.relativeRmse / settings.seeds;
    }
    nlohmann::ordered_json row = {{"rays", settings.frameRays},
                                  {"relative_rmse", std::sqrt(square)},
                                  {"frame_ms", median(milliseconds)},
                                  {"frame_ms_least", *std::min_element(milliseconds.begin(), milliseconds.end())}};
    for (const auto& [name, values] : stages) row["stages_ms"][name] = median(values);
    return row;
}

}  // namespace

int main(int argc, char** argv) {
    Settings settings;
    CLI::App app("Error of the light volume on the built-in scenes, and the time of a frame");
    app.add_option("--scenes", settings.scenes, "Built-in scenes or files")->capture_default_str();
    app.add_option("--points", settings.points, "Points that the cameras see")->capture_default_str();
    app.add_option("--truth-samples", settings.truthSamples, "Paths a point")->capture_default_str();
    app.add_option("--rays", settings.convergedRays, "Rays of a converged run")->capture_default_str();
    app.add_option("--shifts", settings.shifts, "Grid shifts of the converged runs")->capture_default_str();
    app.add_option("--seeds", settings.seeds, "Single frames")->capture_default_str();
    app.add_option("--threads", settings.threads, "0: all")->capture_default_str();
    app.add_flag("--skip-converged", settings.skipConverged, "Single frames only");
    CLI11_PARSE(app, argc, argv);

    const ParallelFor parallelFor = tbbParallelFor(settings.threads);
    nlohmann::ordered_json report = nlohmann::ordered_json::array();
    for (const std::string& name : settings.scenes) {
        const MeasuredScene c = measureScene(loadScene(name), settings.points, settings.truthSamples, parallelFor);
        nlohmann::ordered_json row = {{"scene", name}, {"points", c.points.size()}, {"truth_standard_error", c.truthError}};
        row["one_frame"] = oneFrame(c, settings, parallelFor);
        if (!settings.skipConverged) {
            for (int resolution : {32, 64}) row["converged"].push_back(converged(c, resolution, settings, parallelFor));
        }
        fmt::print(stderr, "{}\n", row.dump());
        report.push_back(row);
    }
    fmt::print("{}\n", report.dump(2));
}
