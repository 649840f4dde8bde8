// Error of the light volume on the built-in scenes, against the path tracer, and the time of a frame: the table of docs/accuracy.md.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bindings/cli/metrics.h"
#include "bindings/cli/pipeline.h"
#include "bindings/embree/path_tracer.h"
#include "bindings/embree/task_pool.h"
#include "bindings/embree/visible_points.h"

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

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values.empty() ? 0.0 : values[values.size() / 2];
}

// Shift `k` of the grid, in cells: no two alike, none a simple fraction.
std::array<double, 3> shiftOf(int k) {
    return {std::fmod(0.13 + 0.618034 * k, 1.0), std::fmod(0.57 + 0.414214 * k, 1.0), std::fmod(0.31 + 0.732051 * k, 1.0)};
}

struct Case {
    Scene scene;
    std::vector<ReferencePoint> points;
    std::vector<glm::vec3> truth;
    double truthError = 0.0;
};

Case prepare(const std::string& name, const Settings& settings, const ParallelFor& parallelFor) {
    Case c{loadScene(name), {}, {}, 0.0};
    const EmbreeScene embree(c.scene);
    for (const ClvReceiver& r : visiblePoints(embree, settings.points, 7)) c.points.push_back({r.position, r.normal});
    std::vector<ReferenceResult> truth(c.points.size());
    ReferenceOptions options;
    options.samplesPerPoint = settings.truthSamples;
    referenceIrradiance(embree, c.points, options, parallelFor, truth);
    double square = 0.0, mean = 0.0;
    for (const ReferenceResult& t : truth) {
        c.truth.push_back(t.irradiance);
        square += glm::dot(t.standardError, t.standardError);
        mean += t.irradiance.x + t.irradiance.y + t.irradiance.z;
    }
    const double n = 3.0 * double(truth.size());
    c.truthError = std::sqrt(square / n) / (mean / n);
    return c;
}

// Mean irradiance of the points that lie in the dark room of two_rooms.
double darkRoomMean(const Case& c, const std::vector<glm::vec3>& values) {
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (c.points[i].position.x < 5.27f) continue;
        sum += values[i].x + values[i].y + values[i].z, ++count;
    }
    return count > 0 ? sum / (3.0 * count) : 0.0;
}

nlohmann::ordered_json converged(const Case& c, int resolution, const Settings& settings, const ParallelFor& parallelFor) {
    double rmse = 0.0, bias = 0.0, worstLeak = 0.0;
    for (int k = 0; k < settings.shifts; ++k) {
        LightOptions options;
        options.resolution = resolution;
        options.rays = settings.convergedRays;
        options.cellShift = shiftOf(k);
        std::vector<glm::vec3> out(c.points.size());
        lightPoints(c.scene, options, 1 + std::uint32_t(k), parallelFor, c.points, out);
        const ErrorSummary errors = summarizeErrors(out, c.truth);
        rmse += errors.relativeRmse / settings.shifts, bias += errors.bias / settings.shifts;
        if (c.scene.name == "two_rooms") worstLeak = std::max(worstLeak, darkRoomMean(c, out) / darkRoomMean(c, c.truth));
    }
    nlohmann::ordered_json row = {{"resolution", resolution}, {"relative_rmse", rmse}, {"bias", bias}};
    if (worstLeak > 0.0) row["worst_leak"] = worstLeak;
    return row;
}

// One frame: levels chosen by the library; the first run only warms up.
nlohmann::ordered_json oneFrame(const Case& c, const Settings& settings, const ParallelFor& parallelFor) {
    std::vector<double> milliseconds;
    std::vector<std::pair<std::string, std::vector<double>>> stages;
    double square = 0.0;
    for (int k = 0; k <= settings.seeds; ++k) {
        LightOptions options;
        options.rays = settings.frameRays;
        options.cellShift = shiftOf(k);
        std::vector<glm::vec3> out(c.points.size());
        const PipelineReport report = lightPoints(c.scene, options, 100 + std::uint32_t(k), parallelFor, c.points, out);
        if (k == 0) continue;
        milliseconds.push_back(1e3 * report.frameSeconds);
        for (const auto& [name, seconds] : report.stages) {
            auto found = std::find_if(stages.begin(), stages.end(), [&, &key = name](const auto& s) { return s.first == key; });
            if (found == stages.end()) found = stages.insert(stages.end(), {name, {}});
            found->second.push_back(1e3 * seconds);
        }
        const double error = summarizeErrors(out, c.truth).relativeRmse;
        square += error * error / settings.seeds;
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
        const Case c = prepare(name, settings, parallelFor);
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
