// The levels that keep the light of some bounces, and which of them are shown.
#pragma once
#include <functional>
#include <vector>

#include "bindings/cli/light_job.h"
#include "clv/cpu/level_choice.h"

namespace clv {

class LevelSet : private LevelsInPlay {
public:
    // Gives a level that joins the light of the last rays.
    using Refill = std::function<void(LightLevel&)>;

    LevelSet(LightJob& job, Refill refill) : job_(job), refill_(std::move(refill)) {}

    // Levels without light for about `rays` rays: the job's grids, the resolution that is given, or the first ones to choose from. Those of
    // `like` are copied, not built again. The lighting must outlive the set's use.
    void begin(Lighting& lighting, double rays, std::span<const LitLevel> like = {});

    // Where the resolution is chosen: see LevelChoice::judge().
    void judge(double done, double target, bool settled, std::span<const LitLevel> like = {});
    // Coarse to fine, or those of the job's grids; mixed by their weights.
    std::span<const LitLevel> levels() const { return levels_; }
    std::size_t bytes() const;

private:
    void add(int resolution, const std::function<Level()>& build);
    void addChosen(int resolution);

    int count() const override { return int(levels_.size()); }
    double rays(int level) const override { return levels_[std::size_t(level)].light->rays(); }
    void estimate(int level, HalfEstimates& estimates) const override;
    bool addFiner() override;
    void setWeight(int level, double weight) override { levels_[std::size_t(level)].weight = weight; }
    void drop(int level) override { levels_.erase(levels_.begin() + level); }

    LightJob& job_;
    Refill refill_;
    Lighting* lighting_ = nullptr;
    std::span<const LitLevel> like_;
    std::vector<LitLevel> levels_;
    LevelChoice choice_;
};

}  // namespace clv
