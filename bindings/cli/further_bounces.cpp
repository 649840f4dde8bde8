#include "bindings/cli/further_bounces.h"

#include <algorithm>

#include <fmt/format.h>

#include "clv/stages/rays.h"

namespace clv {
namespace {

constexpr std::size_t kFollowed = 512 << 10;  // rays of the first bounce that are followed at once
constexpr std::size_t kTrialShare = 16, kMostTrial = 8 << 10, kFewestToTry = 1 << 10;  // rays of the trial, and those of which one is made

// Rays of the first bounce that are followed at once, at most.
std::uint64_t mostFollowed(const LightOptions& options) {
    const std::uint64_t frame = options.seconds > 0.0 ? 0 : options.rays / std::uint64_t(std::max(options.frames, 1u));
    const std::uint64_t most = kFollowed + std::max<std::uint64_t>(kFollowed, options.frames > 1 ? frame : 0);
    return options.seconds > 0.0 ? most : std::min(most, options.rays);
}

std::unique_ptr<Lighting> makeLighting(LightJob& job) {
    LightingSettings settings = job.lightingSettings(job.halves, mostFollowed(job.options), 0x100u);
    settings.emitters = (mostFollowed(job.options) / kEmitterWidth + 64) * kEmitterWidth;  // shots are rounded up
    return job.makeLighting(settings);
}

}  // namespace

FurtherBounces::FurtherBounces(LightJob& job)
    : job_(job), lighting_(makeLighting(job)), levels_(job, [this](LightLevel& level) { lighting_->add(last_, level); }) {
    for (int half = 0; half < job.halves; ++half) halves_.push_back({LightWalk(*lighting_, job.scene.bounds), {}, {}});
}

// Walks of few rays lose dim places soon, so that small shots are followed together, unless time is short.
void FurtherBounces::follow(FirstBounce& first, std::size_t rays, double target) {
    const std::size_t perHalf = rays / halves_.size();
    if (target_ == 0.0) left_ = double(first.pilots()) / double(halves_.size());
    for (std::size_t half = 0; half < halves_.size(); ++half) {
        const LitPlaces more = first.takeLit(int(half));
        LitPlaces& lit = halves_[half].lit;
        lit.sent += more.sent * double(perHalf);
        for (ClvRsmTexel texel : more.texels) {
            texel.flux *= float(perHalf);
            lit.texels.push_back(texel);
        }
    }
    shot_ += perHalf, left_ += double(perHalf), target_ = target;
    if (shot_ * halves_.size() >= kFollowed || job_.options.seconds > 0.0) followAll(first.levels());
}

void FurtherBounces::followAll(std::span<const LitLevel> first) {
    if (walks_ == 0) levels_.begin(*lighting_, target_, first);
    for (Half& half : halves_) {
        half.lit.sent /= double(shot_);
        for (ClvRsmTexel& texel : half.lit.texels) texel.flux /= float(shot_);
    }
    // The trial says how much light later bounces have. Its own is left out: of few rays all is noise.
    if (walks_ == 0 && left_ >= double(kFewestToTry)) {
        walk(std::min(std::size_t(left_) / kTrialShare, kMostTrial));
        done_ = 0.0;
    }
    walk(std::size_t(std::clamp(left_, 0.0, double(mostFollowed(job_.options)))));
    for (const LitLevel& level : levels_.levels()) lighting_->add(last_, *level.light);
    for (Half& half : halves_) half.lit = {};
    shot_ = 0;
    levels_.judge(done_, std::max(target_, done_), done_ >= target_ / 3.0, first);
}

// Fills last_. What a walk weighs is how many rays it was to have, not how many it came to need: else the light of those that end soon would weigh less.
void FurtherBounces::walk(std::size_t raysOfHalf) {
    job_.clock.time("walk", [&] {
        std::size_t most = std::max<std::size_t>(raysOfHalf, 1), needed = 0;
        for (Half& half : halves_) {
            half.rays = half.walk.follow(half.lit, raysOfHalf, clvHashCombine(job_.seed, 0x103u + walks_++));
            most = std::max(most, half.rays.size()), needed = std::max(needed, half.rays.size());
            job_.report.rays += half.rays.size();
        }
        last_.clear();
        for (Half& half : halves_) {
            for (ClvRay& ray : half.rays) ray.flux *= float(double(most) / double(half.rays.size()));
            half.rays.resize(most, clvDeadRay());
            last_.insert(last_.end(), half.rays.begin(), half.rays.end());
            half.rays = {};
        }
        done_ += double(last_.size()), left_ -= double(needed);
    });
}

std::span<const LitLevel> FurtherBounces::finish(const FirstBounce& first) {
    if (shot_ > 0) followAll(first.levels());
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
