#include "bindings/cli/further_bounces.h"

#include <algorithm>

#include <fmt/format.h>

namespace clv {
namespace {

constexpr std::size_t kTrialShare = 8, kMostTrial = 8 << 10;  // of the first rays: how much light later bounces have, about

std::unique_ptr<Lighting> makeLighting(LightJob& job) {
    const std::uint64_t rays = job.options.seconds > 0.0 ? 2 * kLargestShot : std::min<std::uint64_t>(job.options.rays / 2, 2 * kLargestShot);
    LightingSettings settings = job.lightingSettings(1, rays, 0x100u);
    settings.emitters = (rays / kEmitterWidth + 64) * kEmitterWidth;  // shots are rounded up
    return job.makeLighting(settings);
}

}  // namespace

FurtherBounces::FurtherBounces(LightJob& job) : job_(job), lighting_(makeLighting(job)), walk_(*lighting_, job.scene.bounds) {}

// Walks of few rays lose dim places soon, so that small shots are followed together, unless time is short.
void FurtherBounces::follow(std::span<const ClvRsmTexel> lit, std::size_t rays, std::span<const LitLevel> first) {
    for (ClvRsmTexel texel : lit) {
        texel.flux *= float(rays);
        lit_.push_back(texel);
    }
    shot_ += rays, left_ += double(rays);
    if (shot_ >= kLargestShot || job_.options.seconds > 0.0) walk(first);
}

void FurtherBounces::walk(std::span<const LitLevel> first) {
    takeLevels(first);
    for (ClvRsmTexel& texel : lit_) texel.flux /= float(shot_);
    if (walks_ == 0) walk(std::min(std::size_t(left_) / kTrialShare, kMostTrial));
    walk(std::size_t(std::max(left_, 0.0)));
    lit_.clear();
    shot_ = 0;
}

void FurtherBounces::walk(std::size_t count) {
    std::span<const ClvRay> rays;
    job_.clock.time("walk", [&] { rays = walk_.follow(lit_, count, clvHashCombine(job_.seed, 0x103u + walks_++)); });
    if (rays.empty()) return;
    for (const LitLevel& level : levels_) lighting_->add(rays, *level.light);
    job_.report.rays += rays.size();
    left_ -= double(rays.size());
}

void FurtherBounces::takeLevels(std::span<const LitLevel> first) {
    std::vector<LitLevel> levels;
    for (const LitLevel& one : first) {
        const auto same = std::ranges::find(levels_, one.lookups, &LitLevel::lookups);
        if (same != levels_.end()) levels.push_back(std::move(*same));
        else levels.push_back(job_.makeLit(*lighting_, one.resolution, one.light->level(), one.lookups));
        levels.back().weight = one.weight;
    }
    levels_ = std::move(levels);
}

std::span<const LitLevel> FurtherBounces::finish(std::span<const LitLevel> first) {
    if (shot_ > 0) walk(first);
    takeLevels(first);
    for (const LitLevel& level : levels_) job_.report.bytes += level.light->bytes();
    job_.report.sweeps = std::uint32_t(walk_.bounces());
    job_.report.contraction = std::max({walk_.pace().x, walk_.pace().y, walk_.pace().z});
    if (walk_.limitless())
        job_.report.warnings.push_back(fmt::format(
            "bounce {} still carries {:.4f} of the power of the one before: surfaces reflect all light and nothing absorbs it, so "
            "there is no finite answer; what is given is the light of the first {} bounces",
            kLastWithoutLimit, job_.report.contraction, kLastWithoutLimit));
    return levels_;
}

}  // namespace clv
