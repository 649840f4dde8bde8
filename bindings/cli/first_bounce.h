// Light straight from the lights' maps, in levels that are chosen by how much they err.
#pragma once
#include <functional>

#include "bindings/cli/light_job.h"
#include "clv/cpu/level_choice.h"

namespace clv {

class FirstBounce : private LevelsInPlay {
public:
    explicit FirstBounce(LightJob& job) : job_(job) {}

    // Called after each round of rays, of which a number of frames has as many.
    using AfterRound = std::function<void(std::uint32_t round)>;

    // Spends the rays that the options give it; says in the job's report what it took.
    void run(const AfterRound& afterRound = {});

    // The levels, mixed, give one bounce.
    std::span<const LitLevel> levels() const { return levels_; }
    // Mean over all rays, where there are further bounces.
    const SentPower& sent() const { return sent_; }

private:
    void addLevel(int resolution);
    void addLevel(int resolution, Level level);
    void shoot(std::size_t count);
    bool pilot(std::uint64_t budget);

    int count() const override { return int(levels_.size()); }
    double rays(int level) const override { return levels_[std::size_t(level)].light->rays(); }
    void estimate(int level, HalfEstimates& estimates) const override;
    bool addFiner() override;
    void setWeight(int level, double weight) override { levels_[std::size_t(level)].weight = weight; }
    void drop(int level) override { levels_.erase(levels_.begin() + level); }

    LightJob& job_;
    std::unique_ptr<Lighting> lighting_;
    std::vector<LitLevel> levels_;  // coarse to fine, or those of the job's grids
    LevelChoice choice_;
    std::optional<RayGuide> guide_;
    std::size_t pilots_ = 0;
    SentPower sent_;
};

}  // namespace clv
