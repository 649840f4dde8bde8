// Light straight from the lights' maps, in levels that are chosen by how much they err.
#pragma once
#include "bindings/cli/light_job.h"
#include "clv/cpu/resolution.h"

namespace clv {

class FirstBounce {
public:
    explicit FirstBounce(LightJob& job) : job_(job) {}

    // Spends the rays that the options give it; says in the job's report what it took.
    void run();

    // The levels, mixed, give one bounce.
    std::span<const LitLevel> levels() const { return levels_; }
    // Mean over all rays, where there are further bounces.
    const SentPower& sent() const { return sent_; }

private:
    void addLevel(int resolution);
    void shoot(std::size_t count);
    bool pilot(std::uint64_t budget);
    void judge(double targetRays, bool settled);
    void estimate(const LitLevel& level, HalfEstimates& estimates) const;

    LightJob& job_;
    std::unique_ptr<Lighting> lighting_;
    std::vector<LitLevel> levels_;  // coarse to fine
    std::vector<HalfEstimates> estimates_;
    bool settled_ = false;          // no further level joins
    std::optional<RayGuide> guide_;
    std::size_t pilots_ = 0;
    SentPower sent_;
};

}  // namespace clv
