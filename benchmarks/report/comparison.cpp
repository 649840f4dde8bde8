#include "benchmarks/report/comparison.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

#include <fmt/format.h>

#include "benchmarks/report/curves.h"
#include "benchmarks/report/text.h"
#include "bindings/scene/scene.h"

namespace clv {
namespace {

constexpr double kMostRatioGrowth = 1.2;

struct Pair {
    const Measurement* before;
    const Measurement* now;
};

// A measurement's key without the program that measured it.
std::string questionOf(const Measurement& m) {
    return m.key.substr(0, m.key.rfind("; "));
}

// Of the least times, which other programs on the machine disturb least: the mean logarithm, before and now.
struct Cost {
    double before = 0.0, now = 0.0;
    int count = 0;

    void add(const Pair& pair) {
        ++count;
        before += (std::log(pair.before->frameSecondsLeast) - before) / count;
        now += (std::log(pair.now->frameSecondsLeast) - now) / count;
    }
};

}  // namespace

std::vector<Measurement> readReport(const std::filesystem::path& file) {
    std::ifstream input(file, std::ios::binary);
    if (!input) throw InputError(fmt::format("{}: cannot be read; expected the report.json of an earlier report", file.string()));
    try {
        const auto report = nlohmann::ordered_json::parse(input);
        std::vector<Measurement> all;
        for (const auto& json : report.at("measurements")) all.push_back(measurementFrom(json));
        return all;
    } catch (const nlohmann::json::exception&) {
        throw InputError(fmt::format("{}: expected the report.json of an earlier report", file.string()));
    }
}

std::vector<std::string> findRegressions(std::span<const Measurement> before, std::span<const Measurement> now) {
    std::vector<Pair> pairs;
    for (const Measurement& m : now) {
        const auto same = std::ranges::find(before, questionOf(m), questionOf);
        if (same != before.end()) pairs.push_back({&*same, &m});
    }
    if (pairs.empty()) throw InputError("the report to compare with has no measurement in common with this one; expected the same scenes, methods and numbers of points, paths and repeats");

    std::vector<std::string> worse;
    const CurveLabels labels(now);
    std::map<std::string, std::map<std::string, Cost>> costs;  // a scene, a method
    for (const Pair& pair : pairs) {
        const double growth = pair.now->errors.relativeRmse - pair.before->errors.relativeRmse;
        const double slack = std::hypot(pair.before->errorInterval, pair.now->errorInterval);
        if (!(growth <= slack)) {
            worse.push_back(fmt::format("{}, {}: relative RMSE {}, was {}, intervals {}", pair.now->scene, labels.setting(*pair.now),
                                        percentText(pair.now->errors.relativeRmse), percentText(pair.before->errors.relativeRmse), percentText(slack)));
        }
        costs[pair.now->scene][pair.now->method].add(pair);
    }
    for (const auto& [scene, methods] : costs) {
        const auto own = methods.find(kLibraryName);
        if (own == methods.end()) continue;
        for (const auto& [method, cost] : methods) {
            const double ratioBefore = std::exp(own->second.before - cost.before), ratioNow = std::exp(own->second.now - cost.now);
            if (ratioNow > kMostRatioGrowth * ratioBefore)
                worse.push_back(fmt::format("{}: time of {} over that of {} is {:.3g}, was {:.3g}", scene, kLibraryName, method, ratioNow, ratioBefore));
        }
    }
    return worse;
}

}  // namespace clv
