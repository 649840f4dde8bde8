#include "bindings/cli/further_bounces.h"

#include <algorithm>

#include <fmt/format.h>

#include "clv/stages/rays.h"

namespace clv {
namespace {

constexpr std::size_t kFollowed = 512 << 10;  // rays of the first bounce that are followed at once
constexpr std::size_t kTrialShare = 8, kMostTrial = 8 << 10, kFewestToTry = 1 << 10;  // of the first rays: how much light later bounces have, about

std::unique_ptr<Lighting> makeLighting(LightJob& job) {
    const std::uint64_t rays = job.options.seconds > 0.0 ? 2 * kFollowed : std::min<std::uint64_t>(job.options.rays / 2, 2 * kFollowed);
    LightingSettings settings = job.lightingSettings(job.halves, rays, 0x100u);
    settings.emitters = (rays / kEmitterWidth + 64) * kEmitterWidth;  // shots are rounded up
    return job.makeLighting(settings);
}

}  // namespace

FurtherBounces::FurtherBounces(LightJob& job)
    : job_(job), lighting_(makeLighting(job)), levels_(job, [this](LightLevel& level) { lighting_->add(last_, level); }) {
    for (int half = 0; half < job.halves; ++half) halves_.push_back({LightWalk(*lighting_, job.scene.bounds), {}, {}});
}

// Walks of few rays lose dim places soon, so that small shots are followed together, unless time is short.
void FurtherBounces::follow(FirstBounce& first, std::size_t rays) {
    const std::size_t perHalf = rays / halves_.size();
    for (std::size_t half = 0; half < halves_.size(); ++half) {
        for (ClvRsmTexel texel : first.takeLit(int(half))) {
            texel.flux *= float(perHalf);
            halves_[half].lit.push_back(texel);
        }
    }
    shot_ += perHalf, left_ += double(perHalf);
    if (shot_ * halves_.size() >= kFollowed || job_.options.seconds > 0.0) walk(first.levels());
}

void FurtherBounces::walk(std::span<const LitLevel> first) {
    if (walks_ == 0) levels_.begin(*lighting_, target(), first);
    for (Half& half : halves_) {
        for (ClvRsmTexel& texel : half.lit) texel.flux /= float(shot_);
    }
    if (walks_ == 0 && left_ >= double(kFewestToTry)) walk(std::min(std::size_t(left_) / kTrialShare, kMostTrial));
    walk(std::size_t(std::max(left_, 0.0)));
    for (Half& half : halves_) half.lit.clear();
    shot_ = 0;
    if (done_ > 0) levels_.judge(double(done_), std::max(target(), double(done_)), double(done_) >= target() / 3.0, first);
}

// Rays of all walks, as far as is known.
double FurtherBounces::target() const { return job_.options.seconds > 0.0 ? 2.0 * kFollowed : double(job_.options.rays / 2); }

void FurtherBounces::walk(std::size_t raysOfHalf) {
    job_.clock.time("walk", [&] {
        std::size_t most = 0;
        last_.clear();
        for (Half& half : halves_) {
            half.rays = half.walk.follow(half.lit, raysOfHalf, clvHashCombine(job_.seed, 0x103u + walks_++));
            most = std::max(most, half.rays.size());
        }
        // As many of each half, their means unchanged.
        for (Half& half : halves_) {
            for (ClvRay& ray : half.rays) ray.flux *= float(most) / float(half.rays.size());
            half.rays.resize(most, clvDeadRay());
            last_.insert(last_.end(), half.rays.begin(), half.rays.end());
            half.rays = {};
        }
        job_.report.rays += last_.size(), done_ += last_.size();
        left_ -= double(most);
    });
    if (last_.empty()) return;
    for (const LitLevel& level : levels_.levels()) lighting_->add(last_, *level.light);
}

std::span<const LitLevel> FurtherBounces::finish(const FirstBounce& first) {
    if (shot_ > 0) walk(first.levels());
    job_.report.bytes += levels_.bytes();
    bool limitless = false;
    for (const Half& half : halves_) {
        job_.report.sweeps = std::max(job_.report.sweeps, std::uint32_t(half.walk.bounces()));
        job_.report.contraction = std::max({job_.report.contraction, half.walk.pace().x, half.walk.pace().y, half.walk.pace().z});
        limitless = limitless || half.walk.limitless();
    }
    if (limitless)
        job_.report.warnings.push_back(fmt::format(
            "bounce {} still carries {:.4f} of the power of the one before: surfaces reflect all light and nothing absorbs it, so "
            "there is no finite answer; what is given is the light of the first {} bounces",
            kLastWithoutLimit, job_.report.contraction, kLastWithoutLimit));
    return levels_.levels();
}

}  // namespace clv
