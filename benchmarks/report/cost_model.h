// What a setting of this library will cost and how far it will err, foretold from a small trial in the scene and from how trials
// elsewhere on the same machine turned out.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include <nlohmann/json.hpp>

namespace clv {

// A few frames of one resolution in a scene.
struct Trial {
    int resolution = 32;               // about resolution^3 cells
    double leastRays = 0, fewRays = 0, rays = 0;  // of a frame; from fewRays on some of them are pilots
    double leastSeconds = 0, fewSeconds = 0, seconds = 0;  // of those frames, lookups among them
    double leastNoise = 0, fewNoise = 0, noise = 0;  // relative standard deviation between them
    double floor = 0;                  // relative RMSE that remains without the noise
};

struct Outcome {
    double rays = 0, seconds = 0, error = 0;
};

// A trial, and what larger frames gave there.
struct TrialOutcomes {
    Trial trial;
    std::vector<Outcome> outcomes;
};

struct Forecast {
    int resolution = 0;
    double rays = 0;
    double seconds = 0, error = 0;
    double secondsFactor = 1, errorFactor = 1;  // with 95 % the true value is at most this many times larger or smaller
};

// Seconds grow along the line through the trial's two larger frames, before them along its parallel through the least one, and beyond
// them by (rays / trial's rays)^timeGrowth. Noise, on top of the floor, lies on straight lines in logarithms between the trial's frames, and
// before and beyond them falls as rays^noiseFall.
class CostModel {
public:
    // Needs at least three outcomes with more rays than their trials.
    static CostModel fit(std::span<const TrialOutcomes> all);

    Forecast forecast(const Trial& trial, double rays) const;
    // The one that errs least within `seconds`; nothing where a trial's frame of a single ray takes longer.
    std::optional<Forecast> within(double seconds, std::span<const Trial> trials) const;
    // The fastest one that errs at most so much; nothing where the floor lies above for all trials.
    std::optional<Forecast> reaching(double error, std::span<const Trial> trials) const;

    nlohmann::json toJson() const;
    // Throws nlohmann::json::exception.
    static CostModel fromJson(const nlohmann::json& json);

private:
    double timeGrowth_ = 0.0, noiseFall_ = -0.5;
    double secondsFactor_ = 1.0, errorFactor_ = 1.0;
};

}  // namespace clv
