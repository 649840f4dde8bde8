#include "benchmarks/report/growth.h"

#include <algorithm>
#include <map>
#include <regex>

namespace clv {
namespace {

// Run times by the value of a parameter.
struct Sweep {
    std::string name;
    std::map<double, std::vector<double>> seconds;
};

}  // namespace

std::vector<Growth> growthsOf(std::span<const TimedRun> runs) {
    static const std::regex parameter("(?:^|/)[a-z_]+:([0-9.]+)(?=/|$)");
    std::vector<Sweep> sweeps;
    for (const TimedRun& run : runs) {
        for (std::sregex_iterator found(run.name.begin(), run.name.end(), parameter), end; found != end; ++found) {
            const std::string name = run.name.substr(0, std::size_t(found->position(1))) + "*" + run.name.substr(std::size_t(found->position(1) + found->length(1)));
            auto sweep = std::ranges::find(sweeps, name, &Sweep::name);
            if (sweep == sweeps.end()) sweep = sweeps.insert(sweeps.end(), {name, {}});
            sweep->seconds[std::stod((*found)[1])].push_back(run.seconds);
        }
    }
    std::vector<Growth> growths;
    for (const Sweep& sweep : sweeps) {
        if (sweep.seconds.size() < 2) continue;
        // A line through two values fits them always: there the repetitions alone tell how sure it is.
        const bool each = sweep.seconds.size() == 2;
        std::vector<double> values, times;
        for (const auto& [value, seconds] : sweep.seconds) {
            for (const double time : each ? seconds : std::vector{median(seconds)}) values.push_back(value), times.push_back(time);
        }
        growths.push_back({sweep.name, fitPowerLaw(values, times)});
    }
    return growths;
}

}  // namespace clv
