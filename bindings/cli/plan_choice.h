// The setting that a budget of time or a wanted error asks for, foretold, run, and compared with what was promised.
#pragma once
#include <span>

#include "benchmarks/report/trials.h"
#include "bindings/cli/options.h"

namespace clv {

struct ChoiceOptions {
    double budgetMs = 0.0;     // run time of a frame, ms; 0: not set
    double targetError = 0.0;  // relative RMSE; 0: not set
    double readers = 3000.0;   // points that receive the light: their lookups are in the time
    std::size_t points = kTrialPoints;  // where errors are measured
    bool promiseOnly = false;  // do not run it

    bool asked() const { return budgetMs > 0.0 || targetError > 0.0; }
};
void addChoiceOptions(CLI::App& command, ChoiceOptions& options);

// Says in `report` which setting of these resolutions it is and what came of it. The model of this machine is made on first use and kept in the user's
// cache folder. Throws InputError where no setting will do.
void chooseSetting(const Scene& scene, std::span<const int> resolutions, const ChoiceOptions& options, const CommonOptions& common, Report& report);

}  // namespace clv
