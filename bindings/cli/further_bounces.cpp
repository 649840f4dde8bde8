#include "bindings/cli/further_bounces.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bindings/cli/progress.h"
#include "bindings/cli/scene_facts.h"

namespace clv {
namespace {

constexpr int kMostSweeps = 24;                    // bounces
constexpr double kNegligible = 1e-3;               // share of the power at which further bounces are left to the extrapolation
// Of further bounces where none is given, by the rays of all of them.
constexpr int kCoarse = 16, kMiddle = 32, kFine = 64;
constexpr double kRaysForMiddle = 1e6, kRaysForFine = 32e6;
// Above this ratio from bounce to bounce the sum has no stable limit.
constexpr double kLargestRatio = 0.9995;

double total(const glm::dvec3& v) { return v.x + v.y + v.z; }

class FurtherBounces {
public:
    FurtherBounces(LightJob& job, const SentPower& sent)
        : job_(job), power_(sent.on), first_(total(sent.on)), ratio_(total(sent.flux) > 0.0 ? first_ / total(sent.flux) : 0.0),
          budget_(job.options.seconds > 0.0 ? double(job.report.rays) : double(job.options.rays - std::min(job.options.rays, job.report.rays))) {}

    void add(std::span<const LitLevel> source, const TakeLight& take) {
        Progress progress("bounces");
        const double expected = std::clamp(ratio_, 0.02, 0.98);
        const double spread = (1.0 - std::pow(expected, kMostSweeps - 1)) / (1.0 - expected);
        const auto [resolution, level] = chooseLevel(source);
        const auto lookups = job_.makeLookups(level);
        // Two volumes in turn: one is read while the other is filled.
        Pair pair[2];
        for (int sweep = 2; sweep <= kMostSweeps; ++sweep) {
            const double left = ratio_ < 1.0 ? total(power_) / (1.0 - ratio_) : total(power_);
            if (!(total(power_) > 0.0) || left < kNegligible * first_) return;
            if (!emitFrom(source)) return;
            const std::size_t count = std::max<std::size_t>(1, std::size_t(budget_ * std::pow(expected, sweep - 2) / spread));
            Pair& target = pair[sweep % 2];
            if (!target.lighting) {
                LightingSettings settings = job_.lightingSettings(1, count, 0x100u + std::uint32_t(sweep % 2));
                settings.emitters = emitters_.size();
                target.lighting = job_.makeLighting(settings);
                target.level.push_back(job_.makeLit(*target.lighting, resolution, level, lookups));
                job_.report.bytes += target.level[0].light->bytes();
            }
            const glm::dvec3 next = shoot(target, count);
            job_.report.sweeps = std::uint32_t(sweep);
            job_.report.contraction = ratio_ = total(next) / total(power_);
            // Behind the last sweep every further one has about the same shape, fainter by the ratio: a geometric series.
            const bool last = sweep == kMostSweeps || total(next) < kNegligible * (1.0 - std::min(ratio_, 0.999)) * first_;
            if (last && ratio_ >= kLargestRatio) warnOfNoLimit(sweep);
            source = target.level;
            take(source, last && ratio_ < kLargestRatio ? float(1.0 / (1.0 - ratio_)) : 1.0f);
            if (last) return;
            power_ = next;
            progress.update(1.0 - total(power_) / first_);
        }
    }

private:
    struct Pair {
        std::unique_ptr<Lighting> lighting;
        std::vector<LitLevel> level;  // none or one
    };

    // Further bounces have fewer rays and smoother light than the first: where the resolution is not given, they get a coarser level
    // that keeps its noise as low.
    std::pair<int, Level> chooseLevel(std::span<const LitLevel> first) {
        if (!job_.automatic) return {first[0].resolution, first[0].light->level()};
        const int resolution = budget_ < kRaysForMiddle ? kCoarse : budget_ < kRaysForFine ? kMiddle : kFine;
        return {resolution, job_.makeLevel(resolution)};
    }

    // Surfaces send on what the volume says they receive; the sum over the surfaces is set to what the rays brought there, so that no
    // error of the volume's total grows from bounce to bounce. False where they send nothing.
    bool emitFrom(std::span<const LitLevel> source) {
        const SurfaceSamples& surfaces = job_.surfaces;
        bool any = false;
        job_.clock.time("rsm", [&] {
            std::vector<glm::vec3> irradiance(surfaces.receivers.size(), glm::vec3(0.0f));
            addIrradiance(source, &Lookups::surfaces, job_.layout, surfaces.receivers, 1.0f, job_.parallelFor, irradiance);
            emitters_.assign((irradiance.size() + kEmitterWidth - 1) / kEmitterWidth * kEmitterWidth, ClvRsmTexel{});
            glm::dvec3 sum(0.0);
            for (std::size_t k = 0; k < irradiance.size(); ++k) sum += glm::dvec3(surfaces.albedo[k] * irradiance[k]) * double(surfaces.area);
            vec3 correction(0.0f);
            for (int c = 0; c < 3; ++c) correction[c] = sum[c] > 0.0 ? float(power_[c] / sum[c]) : 0.0f;
            for (std::size_t k = 0; k < irradiance.size(); ++k) {
                const vec3 flux = surfaces.albedo[k] * irradiance[k] * (correction * surfaces.area);
                emitters_[k] = {surfaces.receivers[k].position, 0.0f, surfaces.receivers[k].normal, 1u, flux, 0.0f};
                any = any || flux.x + flux.y + flux.z > 0.0f;
            }
        });
        return any;
    }

    // Fills the target with the light of `count` rays. Returns what the surfaces that they hit send on, W a channel.
    glm::dvec3 shoot(Pair& target, std::size_t count) {
        target.lighting->emit(emitters_);
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

    void warnOfNoLimit(int sweep) {
        job_.report.warnings.push_back(fmt::format(
            "bounce {} still carries {:.4f} of the power of the one before: surfaces reflect all light and nothing absorbs it, so "
            "there is no finite answer; what is given is the light of the first {} bounces",
            sweep, ratio_, sweep));
    }

    LightJob& job_;
    glm::dvec3 power_;  // W a channel, that surfaces send on after the last bounce
    const double first_;
    double ratio_;      // by which the power falls from bounce to bounce, about
    const double budget_;  // rays
    std::vector<ClvRsmTexel> emitters_;
};

}  // namespace

void addFurtherBounces(LightJob& job, std::span<const LitLevel> first, const SentPower& sent, const TakeLight& take) {
    FurtherBounces(job, sent).add(first, take);
}

}  // namespace clv
