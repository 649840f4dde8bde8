// Runs stress cases and says what came of each.
#pragma once
#include <span>

#include "bindings/cli/options.h"
#include "bindings/cli/stress/stress_case.h"

namespace clv {

// Prints each case as it ends, and a table of the groups after the last; with --json the report alone, in which everything is. Throws
// std::runtime_error where a case does not hold.
void runStress(std::span<const StressCase> cases, const StressSettings& settings, const CommonOptions& common, Report report);

}  // namespace clv
