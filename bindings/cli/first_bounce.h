// Light straight from the lights' maps, in levels that are chosen by how much they err.
#pragma once
#include <functional>

#include "bindings/cli/light_job.h"
#include "clv/cpu/level_choice.h"

namespace clv {

class FirstBounce : private LevelsInPlay {
public:
    explicit FirstBounce(LightJob& job) : job_(job) {}

    // Called after each round of rays, of which a number of frames has as many; with what the surfaces that they hit send on, where there
    // are further bounces, and the number of these rays.
    using AfterRound = std::function<void(std::uint32_t round, const std::vector<ClvRsmTexel>& lit, std::size_t rays)>;

    // Spends the rays that the options give it; says in the job's report what it took.
    void run(const AfterRound& afterRound = {});

    // The levels, mixed, give one bounce.
    std::span<const LitLevel> levels() const { return levels_; }

private:
    void addLevel(int resolution);
    void addLevel(int resolution, Level level);
    std::size_t shoot(std::size_t count);
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
    std::uint64_t pilots_ = 0, shot_ = 0;  // rays
};

}  // namespace clv
