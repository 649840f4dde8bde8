// One row of a report: a method at one setting in one scene, how far it is from the truth, and what it costs.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/baselines/method.h"
#include "benchmarks/report/metrics.h"
#include "bindings/image/compare_images.h"

namespace clv {

struct Measurement {
    std::string key;                // tells it from all others; the same for the same program and the same question
    std::string scene, method;
    MethodSettings settings;
    std::uint64_t rays = 0;         // asked for, a frame
    int frames = 1;                 // merged

    ErrorSummary errors;            // quadratic mean, mean and mean over the repeats
    double errorInterval = 0.0;     // half width, 95 %, of errors.relativeRmse; infinite for a single repeat
    double truthError = 0.0;        // standard error of the truth, relative like the others: it is in `errors`
    std::optional<double> leak;     // where the scene has a dark side
    ImageErrors picture;

    double setupSeconds = 0.0;      // once a scene
    double mapSeconds = 0.0;        // reflective shadow maps, all frames together
    double frameSeconds = 0.0;      // all frames together: median of the repeats
    double frameSecondsLeast = 0.0, frameSecondsSpread = 0.0;  // the spread is that of the middle half
    double lookupSeconds = 0.0;     // reading the irradiance of all receivers once, median
    std::uint64_t receivers = 0;    // that were read in this time
    bool wholePicture = false;      // they are all pixels of a picture, whose lookups serve several of them each
    bool sharesRays = true;         // else each receiver adds its share to the time of the frames
    std::uint64_t raysTraced = 0;   // all frames together
    std::size_t bytes = 0;

    // Run time for so many receivers, set-up and maps apart; infinite for few ones where lookups are those of a whole picture.
    double seconds(double readers) const;
};

// The value of a setting; empty where the method has none of that name.
std::string settingOf(const Measurement& m, const std::string& name);
// "resolution 32, storage cube9"; empty where a method has nothing to set.
std::string settingsText(const MethodSettings& settings);
// A method with its settings: what makes one curve.
std::string curveName(const Measurement& m);

nlohmann::ordered_json toJson(const Measurement& m);
// Throws nlohmann::json::exception where `json` is no measurement.
Measurement measurementFrom(const nlohmann::ordered_json& json);

// The same as a table: a line of names, and a line each.
std::string csvOf(const std::vector<Measurement>& all);

}  // namespace clv
