// Light straight from the lights' maps, in levels that are chosen by how much they err.
#pragma once
#include <functional>

#include "bindings/cli/level_set.h"

namespace clv {

class FirstBounce {
public:
    explicit FirstBounce(LightJob& job) : job_(job), levels_(job, [this](LightLevel& level) { lighting_->shootAgain(level); }) {}

    // Called after each round of rays, of which a number of frames has as many. target: rays of all rounds, as far as is known.
    using AfterRound = std::function<void(std::uint32_t round, std::size_t rays, double target)>;

    // Spends the rays that the options give it; says in the job's report what it took.
    void run(const AfterRound& afterRound = {});

    // What the surfaces that a half of the last round's rays met send on, where there are further bounces; once a round.
    LitPlaces takeLit(int half) { return lighting_->takeLit(half); }
    // Rays that showed where light goes, and brought none.
    std::uint64_t pilots() const { return pilots_; }
    // The levels, mixed, give one bounce.
    std::span<const LitLevel> levels() const { return levels_.levels(); }

private:
    std::size_t shoot(std::size_t count);
    bool pilot(std::uint64_t budget);

    LightJob& job_;
    std::unique_ptr<Lighting> lighting_;
    LevelSet levels_;
    std::optional<RayGuide> guide_;
    std::uint64_t pilots_ = 0, shot_ = 0;  // rays
};

}  // namespace clv
