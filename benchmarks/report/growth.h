// How run time grows with what a benchmark varies: power laws, from the names of its runs.
#pragma once
#include <span>
#include <string>

#include "benchmarks/report/statistics.h"

namespace clv {

// "inject/cornell/resolution:32/cube9": parts of the form word:number are parameters.
struct TimedRun {
    std::string name;
    double seconds = 0.0;  // > 0
};

struct Growth {
    std::string name;  // that of its runs, with * in place of the parameter's number
    PowerLaw law;      // s, over the parameter
};

// One for each parameter that takes two values or more while the rest of the name stays the same, in the order of the runs. Runs of the
// same name count by their median; where a parameter takes two values alone, each counts, so that their spread gives the interval.
std::vector<Growth> growthsOf(std::span<const TimedRun> runs);

}  // namespace clv
