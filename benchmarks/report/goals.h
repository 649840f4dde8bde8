// What this library has set itself to reach against other methods, and whether it does: shown either way.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "benchmarks/report/curves.h"

namespace clv {

struct GoalResult {
    std::string goal;      // in words
    std::string scene;
    std::string measured;  // in words
    bool reached = false;
};

// Those that the measurements can tell; `pointReaders` and `pictureReaders` receive the light.
std::vector<GoalResult> judgeGoals(std::span<const Measurement> all, double pointReaders, double pictureReaders);

}  // namespace clv
