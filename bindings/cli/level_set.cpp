#include "bindings/cli/level_set.h"

#include <algorithm>

namespace clv {

void LevelSet::begin(Lighting& lighting, double rays, std::span<const LitLevel> like) {
    lighting_ = &lighting, like_ = like;
    const int resolution = job_.options.resolution;
    if (!job_.automatic && !like.empty()) {
        for (const LitLevel& one : like) levels_.push_back(job_.makeLit(lighting, one.resolution, one.light->level(), one.lookups));
        return;
    }
    for (const ClvVolume& grid : job_.grids) add(resolution, [&] { return job_.makeLevel(grid); });
    if (job_.automatic) {
        for (const int one : resolutionsFor(rays).first(2)) addChosen(one);
    } else if (job_.grids.empty()) {
        addChosen(resolution);
    }
}

void LevelSet::judge(double done, double target, bool settled, std::span<const LitLevel> like) {
    like_ = like;
    if (job_.automatic) choice_.judge(*this, done, target, settled);
}

std::size_t LevelSet::bytes() const {
    std::size_t bytes = 0;
    for (const LitLevel& level : levels_) bytes += level.light->bytes();
    return bytes;
}

void LevelSet::add(int resolution, const std::function<Level()>& build) {
    Level level = build();
    auto lookups = job_.makeLookups(level);
    levels_.push_back(job_.makeLit(*lighting_, resolution, std::move(level), std::move(lookups)));
}

void LevelSet::addChosen(int resolution) {
    for (LitLevel& level : levels_) level.weight = 0.0;
    const auto same = std::ranges::find(like_, resolution, &LitLevel::resolution);
    if (same != like_.end()) levels_.push_back(job_.makeLit(*lighting_, resolution, same->light->level(), same->lookups));
    else add(resolution, [&] { return job_.makeLevel(resolution); });
}

bool LevelSet::addFiner() {
    const auto next = std::upper_bound(std::begin(kResolutions), std::end(kResolutions), levels_.back().resolution);
    if (next == std::end(kResolutions)) return false;
    addChosen(*next);
    refill_(*levels_.back().light);
    return true;
}

void LevelSet::estimate(int which, HalfEstimates& estimates) const {
    job_.clock.time("choose", [&] {
        for (auto& half : estimates.half) half.assign(job_.judges.size(), glm::vec3(0.0f));
        addHalves(levels_[std::size_t(which)], &Lookups::judges, job_.layout, job_.judges, 1.0f, job_.parallelFor, estimates);
    });
}

}  // namespace clv
