// What this library has set itself to reach against other methods, and whether it does: shown either way.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "benchmarks/report/curves.h"

namespace clv {

enum class Verdict { missed, reached, open };  // open: these measurements do not tell

struct GoalResult {
    std::string goal;      // in words
    std::string scene;
    std::string measured;  // in words
    Verdict verdict = Verdict::open;
};

// Those that the methods measured are about; `pointReaders` and `pictureReaders` receive the light.
std::vector<GoalResult> judgeGoals(std::span<const Measurement> all, double pointReaders, double pictureReaders);

}  // namespace clv
