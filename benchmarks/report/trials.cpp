#include "benchmarks/report/trials.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "benchmarks/baselines/light_volume.h"
#include "benchmarks/report/metrics.h"
#include "benchmarks/report/statistics.h"
#include "bindings/cli/stage_clock.h"
#include "bindings/scene/generated_scene.h"

namespace clv {
namespace {

constexpr std::uint64_t kTruthSamples = 2048;
constexpr std::uint32_t kTrialPointSeed = 7;
constexpr double kLeastRays = 4 << 10;                        // too few for pilots
constexpr double kFewRays = 16 << 10, kTrialRays = 64 << 10;  // both enough for them
constexpr int kTrialRepeats = 5;
// Of calibration: scenes of several kinds, none of them alike, and frames beside those of the trials.
constexpr const char* kBuiltinScenes[] = {"cornell", "two_rooms"};
constexpr std::uint32_t kGeneratedScenes[] = {11, 12, 13};
constexpr double kOutcomeRays[] = {32 << 10, 256 << 10, 1 << 20};
constexpr int kOutcomeRepeats = 3;

}  // namespace

TrialScene::TrialScene(const EmbreeScene& scene_, double readers_, const ParallelFor& parallelFor_, std::size_t count) : scene(scene_), readers(readers_), parallelFor(parallelFor_) {
    for (const ClvReceiver& r : visiblePoints(scene, count, kTrialPointSeed)) points.push_back({r.position, r.normal});
    if (points.empty()) throw InputError(scene.scene().name + ": its cameras see nothing; expected points to measure at");
    std::vector<ReferenceResult> results(points.size());
    referenceIrradiance(scene, points, {.samplesPerPoint = kTruthSamples}, parallelFor, results);
    for (const ReferenceResult& result : results) truth.push_back(result.irradiance);
    truthError = clv::truthError(results);
}

struct TrialRun::Frames {
    double seconds = 0.0;   // least, which other programs disturb least
    double error = 0.0;     // relative RMSE, quadratic mean, without the noise of the truth
    double noise = 0.0;     // relative standard deviation between the frames
};

TrialRun::TrialRun(const TrialScene& scene, int resolution) : scene_(scene), resolution_(resolution), method_(makeLightVolume({.resolution = resolution})) {
    method_->prepare({scene.scene, scene.parallelFor}, scene.points);
}

TrialRun::~TrialRun() = default;

TrialRun::Frames TrialRun::run(double rays, int repeats) {
    std::vector<double> seconds, errors;
    std::vector<glm::dvec3> sum(scene_.points.size(), glm::dvec3(0.0)), squares = sum;
    std::vector<glm::vec3> irradiance(scene_.points.size());
    // The first one warms up.
    for (int repeat = 0; repeat <= repeats; ++repeat) {
        method_->restart(std::uint32_t(100 + repeat));
        method_->renderMaps();
        const double light = StageClock::secondsOf([&] { method_->frame(std::size_t(rays)); });
        const double lookups = StageClock::secondsOf([&] { method_->irradiance(irradiance); });
        if (repeat == 0) continue;
        seconds.push_back(light + lookups * scene_.readers / double(irradiance.size()));
        errors.push_back(summarizeErrors(irradiance, scene_.truth).relativeRmse);
        for (std::size_t i = 0; i < irradiance.size(); ++i) {
            const glm::dvec3 e(irradiance[i]);
            sum[i] += e, squares[i] += e * e;
        }
    }
    double variance = 0.0;
    for (std::size_t i = 0; i < sum.size(); ++i) {
        const glm::dvec3 spread = (squares[i] - sum[i] * sum[i] / double(repeats)) / (repeats - 1.0);
        variance += (spread.x + spread.y + spread.z) / (3.0 * double(sum.size()));
    }
    const double error = rootMeanSquare(errors).value, mean = meanIrradiance(scene_.truth);
    return {*std::ranges::min_element(seconds), std::sqrt(std::max(0.0, error * error - scene_.truthError * scene_.truthError)), relativeTo(std::sqrt(std::max(0.0, variance)), mean)};
}

Trial TrialRun::trial() {
    const Frames least = run(kLeastRays, kTrialRepeats), few = run(kFewRays, kTrialRepeats), many = run(kTrialRays, kTrialRepeats);
    return {resolution_, kLeastRays, kFewRays, kTrialRays, least.seconds, few.seconds, many.seconds, least.noise, few.noise, many.noise, std::sqrt(std::max(0.0, many.error * many.error - many.noise * many.noise))};
}

Outcome TrialRun::measure(double rays, int repeats) {
    const Frames frames = run(rays, repeats);
    return {rays, frames.seconds, frames.error};
}

CostModel calibrate(double readers, const ParallelFor& parallelFor, const std::function<void(double)>& onProgress) {
    std::vector<Scene> scenes;
    for (const char* name : kBuiltinScenes) scenes.push_back(makeBuiltinScene(name));
    for (const std::uint32_t seed : kGeneratedScenes) scenes.push_back(makeGeneratedScene(seed));
    std::vector<TrialOutcomes> all;
    for (const Scene& scene : scenes) {
        const EmbreeScene embree(scene);
        const TrialScene world(embree, readers, parallelFor);
        for (const int resolution : kTrialResolutions) {
            TrialRun run(world, resolution);
            TrialOutcomes one{run.trial(), {}};
            for (const double rays : kOutcomeRays) one.outcomes.push_back(run.measure(rays, kOutcomeRepeats));
            all.push_back(one);
            onProgress(double(all.size()) / double(scenes.size() * std::size(kTrialResolutions)));
        }
    }
    return CostModel::fit(all);
}

}  // namespace clv
