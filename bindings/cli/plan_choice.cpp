#include "bindings/cli/plan_choice.h"

#include <limits>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "bindings/cli/model_cache.h"
#include "bindings/cli/progress.h"
#include "bindings/cli/standard_streams.h"

namespace clv {
namespace {

constexpr int kVerifyRepeats = 9, kMostPlanPoints = 1 << 20;

CostModel modelOfThisMachine(const ChoiceOptions& options, const CommonOptions& common, const ParallelFor& parallelFor, Report& report) {
    const ModelCache cache(userCacheFolder());
    const nlohmann::json key = modelKey(threadCount(common), options.readers);
    std::optional<CostModel> model = cache.find(key);
    report["model"] = model ? "kept from an earlier run" : "made now";
    if (!model) {
        Progress progress("measuring this machine");
        model = calibrate(options.readers, parallelFor, [&](double share) { progress.update(share); });
        try {
            cache.keep(key, *model);
        } catch (const std::runtime_error& error) {
            sayOnStderr(fmt::format("clv: the model of this machine is not kept: {}", error.what()));
        }
    }
    return *model;
}

Report promiseOf(const Forecast& forecast) {
    return {{"resolution", forecast.resolution},
            {"rays", std::uint64_t(forecast.rays)},
            {"ms", 1e3 * forecast.seconds},
            {"ms_95_percent", {1e3 * forecast.seconds / forecast.secondsFactor, 1e3 * forecast.seconds * forecast.secondsFactor}},
            {"relative_rmse", forecast.error},
            {"relative_rmse_95_percent", {forecast.error / forecast.errorFactor, forecast.error * forecast.errorFactor}}};
}

}  // namespace

void addChoiceOptions(CLI::App& command, ChoiceOptions& options) {
    auto* budget = addPositiveOption(command, "--budget-ms", options.budgetMs, "Choose what errs least within this run time of a frame, ms");
    addPositiveOption(command, "--target-error", options.targetError, "Choose the fastest that errs at most so much (relative RMSE; 0.1 is 10 %)")
        ->check(finiteNumber(0.0, 1.0, "a share such as 0.1, at most 1"))
        ->excludes(budget);
    addPositiveOption(command, "--readers", options.readers, "Points that receive the light; their lookups are in the time")->capture_default_str();
    command.add_option("--points", options.points, "Points where the scene's errors are measured, to foretell them and to compare")->check(CLI::Range(1, kMostPlanPoints))->capture_default_str();
    command.add_flag("--promise-only", options.promiseOnly, "Do not run the choice to compare it with the promise");
}

void chooseSetting(const Scene& scene, std::span<const int> resolutions, const ChoiceOptions& options, const CommonOptions& common, Report& report) {
    const ParallelFor parallelFor = parallelForOf(common);
    const EmbreeScene embree(scene);
    const TrialScene world(embree, options.readers, parallelFor, options.points);
    const CostModel model = modelOfThisMachine(options, common, parallelFor, report);
    std::map<int, std::unique_ptr<TrialRun>> runs;
    std::vector<Trial> trials;
    for (const int resolution : resolutions) {
        runs[resolution] = std::make_unique<TrialRun>(world, resolution);
        trials.push_back(runs[resolution]->trial());
    }
    const auto chosen = options.budgetMs > 0.0 ? model.within(1e-3 * options.budgetMs, trials) : model.reaching(options.targetError, trials);
    constexpr double kAny = std::numeric_limits<double>::infinity();
    if (!chosen && options.budgetMs > 0.0)
        throw InputError(fmt::format("--budget-ms {:g}: expected at least {:.2g}, what the fastest setting takes in this scene on this machine", options.budgetMs,
                                     1e3 * model.reaching(kAny, trials)->seconds));
    if (!chosen)
        throw InputError(fmt::format("--target-error {:g}: expected at least {:.2g}, what the most exact setting reaches in this scene", options.targetError,
                                     model.within(kAny, trials)->error));
    report["promised"] = promiseOf(*chosen);
    if (options.promiseOnly) return;
    const Outcome outcome = runs.at(chosen->resolution)->measure(chosen->rays, kVerifyRepeats);
    report["measured"] = {{"ms", 1e3 * outcome.seconds},
                          {"relative_rmse", outcome.error},
                          {"ms_over_promised", outcome.seconds / chosen->seconds},
                          {"relative_rmse_over_promised", outcome.error / chosen->error},
                          {"standard_error_of_the_truth", world.truthError}};
}

}  // namespace clv
