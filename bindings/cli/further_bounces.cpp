#include "bindings/cli/further_bounces.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bindings/cli/light_walk.h"
#include "bindings/cli/progress.h"
#include "bindings/cli/scene_facts.h"
#include "clv/cpu/resolution.h"

namespace clv {
namespace {

constexpr int kLastFed = 8;                        // the last bounce that is read from the volume of the one before
constexpr int kLastWithoutLimit = 24;              // the same where there is no end to the light
constexpr double kLeastLater = 0.02, kMostLater = 0.95;  // share of the rays that are left that a bounce leaves to later ones
constexpr double kForTheRest = 0.0625;             // of all rays: a dim room keeps its light when that of the bright place beside it is gone
constexpr double kNegligible = 1e-4;               // share of the power at which further bounces are left out
constexpr double kWalked = 0.125, kSpread = 0.125;  // of the rays that are left to later bounces, those that find where their light is, and those that spread it
constexpr float kNarrow = 0.75f;                   // cells: surfaces whose sight is nearer lie in a gap
constexpr std::size_t kFewestToWalk = 128;         // rays
// Of further bounces where none is given, by the rays of all of them.
constexpr int kCoarse = 16, kMiddle = 32, kFine = 64;
constexpr double kRaysForMiddle = 1e6, kRaysForFine = 32e6;

double total(const glm::dvec3& v) { return v.x + v.y + v.z; }

class FurtherBounces {
public:
    FurtherBounces(LightJob& job, const SentPower& sent)
        : job_(job), power_(sent.on), first_(sent.on), ratio_(ratioOf(sent.on, sent.flux)),
          budget_(job.options.seconds > 0.0 ? double(job.report.rays) : double(job.options.rays - std::min(job.options.rays, job.report.rays))) {}

    void add(std::span<const LitLevel> source, const TakeLight& take) {
        Progress progress("bounces");
        const auto [resolution, level] = chooseLevel(source);
        const auto lookups = job_.makeLookups(level);
        const auto fill = [&](Pair& pair, std::span<const ClvRsmTexel> emitters, std::size_t count, std::uint32_t stream) {
            if (!pair.lighting) {
                LightingSettings settings = job_.lightingSettings(1, count, stream);
                settings.emitters = emitters.size();
                pair.lighting = job_.makeLighting(settings);
                pair.level.push_back(job_.makeLit(*pair.lighting, resolution, level, lookups));
                job_.report.bytes += pair.level[0].light->bytes();
            }
            ++job_.report.sweeps;
            return shoot(pair, emitters, count);
        };
        // Two volumes in turn: one is read while the other is filled.
        Pair pair[2];
        int bounce = 2;
        for (; bounce <= (limitless() ? kLastWithoutLimit : kLastFed); ++bounce) {
            if (negligible() || !emitFrom(source)) return;
            // Rays go to bounces in proportion to their light; all later ones have ratio_ of it, as far as is known.
            const double later = std::clamp(total(power_ * ratio_) / total(power_), kLeastLater, kMostLater);
            const std::size_t count = wholeRays(left_ * (1.0 - later));
            left_ = std::max(left_ - double(count), 0.0);
            const glm::dvec3 next = fill(pair[bounce % 2], emitters_, count, 0x100u + std::uint32_t(bounce % 2));
            ratio_ = ratioOf(next, power_);
            job_.report.contraction = std::max({ratio_.x, ratio_.y, ratio_.z});
            source = pair[bounce % 2].level;
            take(source, 1.0f);
            power_ = next;
            progress.update(1.0 - total(power_) / total(first_));
        }
        if (limitless()) warnOfNoLimit(bounce - 1);
        for (int c = 0; c < 3; ++c) power_[c] = ratio_[c] < kLargestRatio ? power_[c] : 0.0;
        if (negligible() || !emitFrom(source)) return;
        // What is left: all later bounces at once.
        left_ += budget_ * kForTheRest;
        for (Pair& one : pair) one.level.clear(), one.lighting.reset();
        addRest(fill, take);
    }

private:
    struct Pair {
        std::unique_ptr<Lighting> lighting;
        std::vector<LitLevel> level;  // none or one
    };

    // Of many a round number, which back ends whose sums differ in their last places agree on.
    static std::size_t wholeRays(double rays) {
        constexpr double kMany = 1 << 16, kRound = 256;
        return std::max<std::size_t>(1, std::size_t(rays < kMany ? rays : std::floor(rays / kRound) * kRound));
    }
    static glm::dvec3 ratioOf(const glm::dvec3& next, const glm::dvec3& power) {
        glm::dvec3 ratio(0.0);
        for (int c = 0; c < 3; ++c) ratio[c] = power[c] > 0.0 ? next[c] / power[c] : 0.0;
        return ratio;
    }
    bool limitless() const { return std::max({ratio_.x, ratio_.y, ratio_.z}) >= kLargestRatio; }
    // Whether what is left of each channel's light is little of it.
    bool negligible() const {
        for (int c = 0; c < 3; ++c) {
            if (power_[c] / (1.0 - std::min(ratio_[c], kLargestRatio)) > kNegligible * first_[c]) return false;
        }
        return true;
    }

    // Further bounces have fewer rays and smoother light than the first: where the resolution is not given, they get a coarser level
    // that keeps its noise as low, but for places that are lost in its cells: up to the finest that the first bounce chose.
    std::pair<int, Level> chooseLevel(std::span<const LitLevel> first) {
        if (!job_.automatic) return {first[0].resolution, first[0].light->level()};
        int resolution = budget_ < kRaysForMiddle ? kCoarse : budget_ < kRaysForFine ? kMiddle : kFine;
        const int finest = std::ranges::max_element(first, {}, &LitLevel::resolution)->resolution;
        for (const int finer : kResolutions) {
            if (finer > resolution && finer <= finest && job_.cellsInSight(resolution) < 1.0f) resolution = finer;
        }
        return {resolution, job_.makeLevel(resolution)};
    }

    // The light of what the emitters send, and of all bounces after that. A walk finds how much it is and where; its places are few, and
    // bright spots lie before them, so that a volume lit by them is read for what surfaces send on: that leaves all of them. Where there are
    // too few rays to walk, all channels fall as in the last bounce.
    template <class Fill>
    void addRest(const Fill& fill, const TakeLight& take) {
        const auto share = [&](double part) { return wholeRays(part * left_); };
        Pair spread, rest;
        if (share(kWalked) < kFewestToWalk) {
            for (ClvRsmTexel& emitter : emitters_) emitter.flux /= vec3(1.0 - glm::min(ratio_, kLargestRatio));
            fill(rest, emitters_, share(1.0), 0x105u);
            return take(rest.level, 1.0f);
        }
        LightingSettings settings = job_.lightingSettings(1, share(kWalked), 0x102u);
        settings.emitters = std::max(emitters_.size(), kMostWalked);
        auto lighting = job_.makeLighting(settings);
        WalkedLight walked;
        job_.clock.time("walk", [&] { walked = walkOn(*lighting, emitters_, share(kWalked), clvHashCombine(job_.seed, 0x103u), job_.scene.bounds); });
        lighting.reset();
        job_.report.rays += walked.rays, job_.report.walked = walked.bounces;
        fill(spread, walked.emitters, share(kSpread), 0x104u);
        const std::vector<ClvRsmTexel> first = emitters_;
        power_ = fluxOf(walked.emitters) - fluxOf(first);
        if (emitFrom(spread.level)) {
            for (std::size_t k = 0; k < first.size(); ++k) emitters_[k].flux += first[k].flux;
        } else {
            emitters_ = first;
        }
        fill(rest, emitters_, share(1.0 - kWalked - kSpread), 0x105u);
        take(rest.level, 1.0f);
    }

    static float widestCell(std::span<const LitLevel> levels) {
        float widest = 0.0f;
        for (const LitLevel& level : levels) widest = std::max(widest, level.weight > 0.0 ? level.light->level().volume.cellSize : 0.0f);
        return widest;
    }

    // Surfaces send on what the volume says they receive, but for those in gaps much narrower than its cells, which would read the light before
    // the gap: they are taken as dark. The sum over the surfaces is set to what the rays brought there, so that no
    // error of the volume's total grows from bounce to bounce. False where they send nothing.
    bool emitFrom(std::span<const LitLevel> source) {
        const SurfaceSamples& surfaces = job_.surfaces;
        bool any = false;
        job_.clock.time("rsm", [&] {
            std::vector<glm::vec3> irradiance(surfaces.receivers.size(), glm::vec3(0.0f));
            addIrradiance(source, &Lookups::surfaces, job_.layout, surfaces.receivers, 1.0f, job_.parallelFor, irradiance);
            const float narrow = kNarrow * widestCell(source);
            for (std::size_t k = 0; k < irradiance.size(); ++k) irradiance[k] *= surfaces.sight[k] < narrow ? 0.0f : 1.0f;
            emitters_.assign((irradiance.size() + kEmitterWidth - 1) / kEmitterWidth * kEmitterWidth, ClvRsmTexel{});
            glm::dvec3 sum(0.0);
            for (std::size_t k = 0; k < irradiance.size(); ++k) sum += glm::dvec3(surfaces.albedo[k] * irradiance[k]) * double(surfaces.area[k]);
            vec3 correction(0.0f);
            for (int c = 0; c < 3; ++c) correction[c] = sum[c] > 0.0 ? float(power_[c] / sum[c]) : 0.0f;
            for (std::size_t k = 0; k < irradiance.size(); ++k) {
                const vec3 flux = surfaces.albedo[k] * irradiance[k] * (correction * surfaces.area[k]);
                emitters_[k] = {surfaces.receivers[k].position, 0.0f, surfaces.receivers[k].normal, 1u, flux, 0.0f};
                any = any || flux.x + flux.y + flux.z > 0.0f;
            }
        });
        return any;
    }

    // Fills the target with the light of `count` rays. Returns what the surfaces that they hit send on, W a channel.
    glm::dvec3 shoot(Pair& target, std::span<const ClvRsmTexel> emitters, std::size_t count) {
        target.lighting->emit(emitters);
        LightLevel* const level = target.level[0].light.get();
        level->reset();
        glm::dvec3 on(0.0);
        for (std::size_t done = 0; done < count;) {
            const std::size_t rays = target.lighting->shoot(std::min(count - done, kLargestShot), {&level, 1});
            on = (on * double(done) + target.lighting->sent().on * double(rays)) / double(done + rays);
            done += rays;
            job_.report.rays += rays;
        }
        return on;
    }

    void warnOfNoLimit(int bounce) {
        job_.report.warnings.push_back(fmt::format(
            "bounce {} still carries {:.4f} of the power of the one before: surfaces reflect all light and nothing absorbs it, so "
            "there is no finite answer; what is given is the light of the first {} bounces",
            bounce, job_.report.contraction, bounce));
    }

    LightJob& job_;
    glm::dvec3 power_;  // W a channel, that surfaces send on after the last bounce
    const glm::dvec3 first_;
    glm::dvec3 ratio_;   // by which the power falls from bounce to bounce, about
    const double budget_;  // rays
    double left_ = budget_ * (1.0 - kForTheRest);
    std::vector<ClvRsmTexel> emitters_;
};

}  // namespace

void addFurtherBounces(LightJob& job, std::span<const LitLevel> first, const SentPower& sent, const TakeLight& take) {
    FurtherBounces(job, sent).add(first, take);
}

}  // namespace clv
