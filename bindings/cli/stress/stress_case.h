// Stiff and extreme cases: what must hold in each, and what was measured.
#pragma once
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "clv/cpu/parallel.h"
#include "clv/plan/number_check.h"

namespace clv {

// A figure with its bound. Without one it is only stated.
struct StressFigure {
    static constexpr double kStated = std::numeric_limits<double>::infinity();

    std::string name;         // with its unit
    double value = 0.0;
    double atMost = kStated;
    // What is not finite holds nowhere.
    bool holds() const { return isFinite(value) && value <= atMost; }
};

// The larger of two; NaN if one of them is.
inline double largerOf(double a, double b) { return isFinite(a) && (!isFinite(b) || b > a) ? b : a; }

struct StressSettings {
    bool exhaustive = false;
    std::uint32_t seed = 1;
    ParallelFor parallelFor;
};

struct StressCase {
    std::string group, name;
    std::string claim;  // what must hold
    std::function<std::vector<StressFigure>(const StressSettings&)> run;
};

std::vector<StressCase> historyCases();
std::vector<StressCase> walkCases();
std::vector<StressCase> fluxCases();
std::vector<StressCase> gridCases();
std::vector<StressCase> propertyCases();
std::vector<StressCase> precisionCases();
std::vector<StressCase> bounceCases();
std::vector<StressCase> brightnessCases();
std::vector<StressCase> sceneCases();
std::vector<StressCase> tailCases();
std::vector<StressCase> movingCases();
std::vector<StressCase> extremeCases();

// All of them, group by group.
std::vector<StressCase> stressCases();

}  // namespace clv
