#include "bindings/cli/pipeline.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "bindings/cli/progress.h"
#include "bindings/cli/scene_facts.h"
#include "bindings/embree/rsm.h"
#include "bindings/embree/surface_samples.h"
#include "bindings/embree/visible_points.h"
#include "clv/cpu/build_level.h"
#include "clv/cpu/lookup_table.h"
#include "clv/cpu/resolution.h"
#include "clv/cpu/still_lighting.h"

namespace clv {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kFirstRound = 64 << 10;      // rays
constexpr std::size_t kLargestRound = 512 << 10;   // rays
constexpr std::size_t kJudges = 1024;              // receivers that choose the resolution
constexpr std::size_t kFewJudges = 500;            // below this, points that the cameras see judge too
constexpr std::size_t kSurfaceSamples = 32 << 10;  // that send the light of further bounces
constexpr std::size_t kMostPilots = 64 << 10;      // rays that show where light goes
constexpr std::uint64_t kPilotShare = 8;           // one ray in so many
constexpr int kMostSweeps = 24;                    // bounces
constexpr double kNegligible = 1e-3;               // share of the power at which further bounces are left to the extrapolation
constexpr int kTexelWidth = 256;                   // rows of the texel sampler

class StageClock {
public:
    template <class Body>
    void time(const std::string& stage, Body&& body) {
        const auto begin = Clock::now();
        body();
        add(stage, std::chrono::duration<double>(Clock::now() - begin).count());
    }
    void add(const std::string& stage, double seconds) {
        for (auto& [name, sum] : stages) {
            if (name == stage) {
                sum += seconds;
                return;
            }
        }
        stages.emplace_back(stage, seconds);
    }
    double of(std::initializer_list<const char*> names) const {
        double sum = 0.0;
        for (const auto& [name, seconds] : stages) {
            if (std::find(names.begin(), names.end(), name) != names.end()) sum += seconds;
        }
        return sum;
    }
    std::vector<std::pair<std::string, double>> stages;
};

std::vector<ClvReceiver> receiversOf(std::span<const ReferencePoint> points) {
    std::vector<ClvReceiver> receivers;
    receivers.reserve(points.size());
    for (const ReferencePoint& p : points) receivers.push_back({p.position, 0.0f, p.normal, 0.0f});
    return receivers;
}

// All of the scene's lights as one stack of RSM texels.
class LightTexels {
public:
    LightTexels(const EmbreeScene& scene, std::uint32_t seed, const ParallelFor& parallelFor) : scene_(scene), seed_(seed), parallelFor_(parallelFor) {
        for (const NamedLight& light : scene.scene().lights) {
            if (sendsLight(light)) lights_.push_back(light.light);
        }
        // 256^2 texels a light, fewer where there are many lights.
        while (side_ > 32 && lights_.size() * side_ * side_ > 8u * 256u * 256u) side_ /= 2;
        texels_.resize(lights_.size() * side_ * side_);
    }
    void render(std::uint32_t pass, TexelSampler& sampler, const RayGuide* guide) {
        const std::size_t each = std::size_t(side_) * side_;
        for (std::size_t k = 0; k < lights_.size(); ++k) {
            renderRsm(scene_, lights_[k], side_, pass, clvHashCombine(seed_, uint(k)), parallelFor_, std::span(texels_).subspan(k * each, each));
        }
        sampler.build(texels_, side_, parallelFor_, guide);
    }

private:
    const EmbreeScene& scene_;
    std::uint32_t seed_;
    const ParallelFor& parallelFor_;
    std::vector<ClvLight> lights_;
    int side_ = 256;
    std::vector<ClvRsmTexel> texels_;
};

class LightRun {
public:
    LightRun(const Scene& scene, const LightOptions& options, std::uint32_t seed, const ParallelFor& parallelFor,
             std::span<const ReferencePoint> points)
        : scene_(scene), options_(options), seed_(seed), parallelFor_(parallelFor), points_(receiversOf(points)),
          needs_(planNeeds(sceneFacts(scene, options))), automatic_(needs_.halves > 1), layout_{options.storage, needs_.channels, needs_.frame} {
        if (!worksAtAll()) return;
        clock_.time("setup", [&] {
            embree_.emplace(scene);
            if (!options.proxy.empty()) {
                proxyScene_ = loadScene(options.proxy);
                moveTo(*proxyScene_, scene.anchor);
                proxy_.emplace(*proxyScene_);
            }
            if (needs_.feedback) surfaces_ = sampleSurfaces(*embree_, kSurfaceSamples, clvHashCombine(seed, 0x5u), parallelFor);
            if (automatic_) chooseJudges();
        });
        texels_.emplace(*embree_, seed, parallelFor);
    }

    PipelineReport run(std::span<glm::vec3> out) {
        std::fill(out.begin(), out.end(), glm::vec3(0.0f));
        if (worksAtAll()) {
            report_.channels = needs_.channels;
            report_.sweeps = 1;
            firstBounce();
            evaluate(firstLight(), out);
            if (needs_.feedback) furtherBounces(out);
        }
        report_.stages = clock_.stages;
        report_.frameSeconds = clock_.of({"guide", "rays", "trace", "inject", "merge", "choose", "evaluate"});
        return std::move(report_);
    }

private:
    bool worksAtAll() const { return needs_.stages && !points_.empty(); }
    static void moveTo(Scene& scene, const glm::dvec3& anchor) {
        const vec3 offset(scene.anchor - anchor);
        for (vec3& p : scene.positions) p += offset;
        scene.bounds.lo += offset, scene.bounds.hi += offset;
        scene.anchor = anchor;
    }

    // The receivers by which levels are judged: some of the points, and with few of them some that the cameras see.
    void chooseJudges() {
        const std::size_t count = std::min(points_.size(), kJudges);
        for (std::size_t k = 0; k < count; ++k) judges_.push_back(points_[k * points_.size() / count]);
        if (count < kFewJudges) {
            const auto seen = visiblePoints(*embree_, kFewJudges, clvHashCombine(seed_, 0x9u));
            judges_.insert(judges_.end(), seen.begin(), seen.end());
        }
    }

    Level makeLevel(int resolution) {
        Level level;
        clock_.time("setup", [&] {
            const ClvVolume volume = volumeOver(scene_, resolution, options_);
            std::vector<std::uint8_t> needed = neededCells(volume, points_);
            for (const auto* more : {&judges_, &surfaces_.receivers}) {
                const auto also = neededCells(volume, *more);
                for (std::size_t i = 0; i < needed.size(); ++i) needed[i] |= also[i];
            }
            level = buildLevel(volume, embree_->probe(), needed, parallelFor_);
        });
        return level;
    }

    // Cuts rays at the scene that they are meant to meet, and notes what they hit where further bounces need it.
    Tracer tracer(const std::unique_ptr<StillLighting>& lighting) {
        return [this, &lighting](std::span<ClvRay> rays) {
            const EmbreeScene& target = proxy_ ? *proxy_ : *embree_;
            if (!needs_.feedback) return target.trace(rays);
            const std::size_t offset = rays.data() - lighting->currentRays().data();
            target.trace(rays, std::span(hits_).subspan(offset, rays.size()));
        };
    }

    std::unique_ptr<StillLighting> makeLighting(std::unique_ptr<StillLighting>& self, int halves, std::uint64_t rays, std::uint32_t stream) {
        StillLightingSettings settings;
        settings.layout = layout_;
        settings.parts = volumeParts(halves, rays);
        settings.seed = clvHashCombine(seed_, stream);
        settings.originOffset = embree_->surfaceOffset();
        return std::make_unique<StillLighting>(settings, tracer(self), parallelFor_);
    }

    // Traces `count` rays, rounded up so that all parts of the volume get as many. Returns how many that are.
    std::size_t trace(StillLighting& lighting, const TexelSampler& sampler, std::size_t count) {
        clock_.time("rays", [&] { lighting.rays(sampler, count); });
        if (needs_.feedback) hits_.resize(std::max(hits_.size(), lighting.currentRays().size()));
        clock_.time("trace", [&] { lighting.trace(); });
        report_.rays += lighting.currentRays().size();
        return lighting.currentRays().size();
    }

    // A few rays show where the light goes; where much of it leaves the scene, the others are guided.
    std::size_t pilot(std::uint64_t budget) {
        TexelSampler sampler;
        clock_.time("rsm", [&] { texels_->render(0, sampler, nullptr); });
        if (sampler.empty()) return 0;
        const std::size_t count = std::size_t(std::min<std::uint64_t>(kMostPilots, budget / kPilotShare));
        const std::span<ClvRay> rays = std::span(pilotRays_).first(count);
        clock_.time("guide", [&] {
            constexpr std::size_t kPiece = 2048;
            const std::uint32_t seed = clvHashCombine(seed_, 0x7u);
            parallelFor_((count + kPiece - 1) / kPiece, [&](std::size_t piece) {
                const auto part = rays.subspan(piece * kPiece, std::min(kPiece, count - piece * kPiece));
                makeRays(sampler, uint(piece * kPiece), seed, embree_->surfaceOffset(), part);
                (proxy_ ? *proxy_ : *embree_).trace(part);
            });
            guide_->learn(rays);
            guide_->finish();
            report_.shareThatMeets = guide_->share();
            report_.guided = guide_->worthwhile();
            if (!report_.guided) guide_.reset();
        });
        report_.rays += count;
        pilots_ = count;
        return count;
    }
    void inject(StillLighting& lighting, Volume& volume) {
        clock_.time("inject", [&] { lighting.inject(volume); });
        clock_.time("merge", [&] { lighting.merge(volume); });
    }

    // Power of all rays of the last trace, and what of it the surfaces that they hit send on; W a channel.
    std::pair<glm::dvec3, glm::dvec3> sentOn(const StillLighting& lighting) const {
        glm::dvec3 flux(0.0), on(0.0);
        const auto rays = lighting.currentRays();
        for (std::size_t k = 0; k < rays.size(); ++k) {
            flux += glm::dvec3(rays[k].flux);
            if (hits_[k].primitive != 0xffffffffu) on += glm::dvec3(rays[k].flux * hits_[k].albedo);
        }
        return {flux / double(rays.size()), on / double(rays.size())};
    }

    void firstBounce() {
        std::uint64_t budget = options_.seconds > 0.0 ? ~std::uint64_t(0) : options_.allBounces ? std::max<std::uint64_t>(options_.rays / 2, 1) : options_.rays;
        lighting_ = makeLighting(lighting_, needs_.halves, budget, 1);
        clock_.time("setup", [&] {
            lighting_->reserveRays(std::size_t(std::min<std::uint64_t>(budget, options_.frames > 1 ? budget / options_.frames : kFirstRound)));
            estimates_.resize(2);
            for (HalfEstimates& e : estimates_) e.half[0].resize(judges_.size()), e.half[1].resize(judges_.size());
            pilotRays_.resize(kMostPilots);
            guide_.emplace(scene_.bounds.lo, scene_.bounds.hi);
        });
        addLevel(automatic_ ? kResolutions[0] : options_.resolution);
        if (automatic_) addLevel(kResolutions[1]);

        Progress progress("light");
        TexelSampler sampler;
        const std::uint64_t pilots = pilot(options_.seconds > 0.0 ? kFirstRound : budget);
        if (options_.seconds <= 0.0) budget -= pilots;
        std::uint64_t done = 0;
        // While levels are judged all of them are filled, so this ends with about the first quarter of the rays. A power of two: the
        // halves of other stretches of the sequence fill each other's gaps, and what is meant to judge the bias shows less of it.
        const std::uint64_t judged = automatic_ ? std::bit_floor(std::max<std::uint64_t>(budget / 3, 1)) : 0;
        std::size_t round = options_.frames > 1 ? std::size_t((budget + options_.frames - 1) / options_.frames) : kFirstRound;
        if (automatic_ && done < judged) round = std::size_t(std::min<std::uint64_t>(round, judged));
        std::uint64_t sinceRsm = 0;
        const double timeForThis = options_.allBounces ? 0.5 * options_.seconds : options_.seconds;
        for (std::uint32_t pass = 0; done < budget; ++pass) {
            const double before = progress.seconds();
            if (pass == 0 || sinceRsm >= kFirstRound) {
                clock_.time("rsm", [&] { texels_->render(pass, sampler, guide_ ? &*guide_ : nullptr); });
                sinceRsm = 0;
            }
            if (sampler.empty()) return;
            const std::size_t count = trace(*lighting_, sampler, std::size_t(std::min<std::uint64_t>(round, budget - done)));
            for (Volume& volume : lighting_->volumes()) inject(*lighting_, volume);
            done += count;
            sinceRsm += count;
            if (needs_.feedback) {
                const auto [flux, on] = sentOn(*lighting_);
                sent_ += flux * double(count), sentOn_ += on * double(count);
            }
            const double now = progress.seconds();
            // With a budget of time, as many rays are still to come as the pace so far promises.
            const double target = options_.seconds > 0.0 ? std::max(double(done), double(done) * timeForThis / std::max(now, 1e-6)) : double(budget);
            if (resolutions_.size() > 1) judge(target, options_.seconds > 0.0 ? double(done) >= 0.25 * target : done >= judged);
            if (options_.seconds > 0.0 && now + (now - before) > timeForThis) break;
            progress.update(options_.seconds > 0.0 ? now / timeForThis : double(done) / double(budget));
            if (options_.frames <= 1) round = settled_ || !automatic_ ? kLargestRound : std::min(2 * round, kLargestRound);
        }
        sent_ /= double(done), sentOn_ /= double(done);
        for (const Volume& volume : lighting_->volumes()) report_.bytes += volume.bytes(), report_.slots += volume.level().slots.size();
        for (std::size_t l = 0; l < resolutions_.size(); ++l) {
            if (mix_[l] > 0.0) report_.levels.emplace_back(resolutions_[l], mix_[l]);
        }
    }

    void addLevel(int resolution) {
        Level level = makeLevel(resolution);
        clock_.time("setup", [&] {
            lookups_.push_back(makeLookups(level));
            lighting_->addLevel(std::move(level));
        });
        resolutions_.push_back(resolution);
        mix_ = {};
        mix_[resolutions_.size() - 1] = 1.0;
    }

    void removeLevel(std::size_t l) {
        lighting_->volumes().erase(lighting_->volumes().begin() + std::ptrdiff_t(l));
        lookups_.erase(lookups_.begin() + std::ptrdiff_t(l));
        resolutions_.erase(resolutions_.begin() + std::ptrdiff_t(l));
        std::rotate(mix_.begin() + std::ptrdiff_t(l), mix_.begin() + std::ptrdiff_t(l) + 1, mix_.end());
    }

    // Foretells the errors once `targetRays` are in. Until the choice is `settled` a finer level joins while the finest one is the best;
    // then levels that err clearly more are dropped.
    void judge(double targetRays, bool settled) {
        LevelErrors errors;
        std::vector<double> factor;
        for (;;) {
            clock_.time("choose", [&] {
                estimates_.resize(resolutions_.size());
                factor.clear();
                for (std::size_t l = 0; l < resolutions_.size(); ++l) {
                    const Volume& volume = lighting_->volumes()[l];
                    estimate(volume, lookups_[l].judges, estimates_[l]);
                    // A level that joined late has missed the rays before it.
                    const double missed = double(report_.rays - pilots_) - volume.rays();
                    factor.push_back(std::max(1.0, (targetRays - missed) / volume.rays()));
                }
                errors = judgeLevels(estimates_).withRays(factor);
            });
            const auto next = std::upper_bound(std::begin(kResolutions), std::end(kResolutions), resolutions_.back());
            if (settled_ || bestLevel(errors) + 1 < errors.count || next == std::end(kResolutions)) break;
            addLevel(*next);
            inject(*lighting_, lighting_->volumes().back());
        }
        mix_ = chooseLevels(errors);
        settled_ = settled_ || settled;
        if (!settled_) return;
        for (int l = errors.count; l-- > 0;) {
            if (mix_[l] == 0.0 && !staysInPlay(errors, l)) removeLevel(std::size_t(l));
        }
    }

    void estimate(const Volume& volume, const LookupTable& lookup, HalfEstimates& estimates) const {
        for (auto& half : estimates.half) half.resize(judges_.size());
        forReceivers(judges_.size(), [&](std::size_t i) {
            const ClvCoefficients coefficients = layout_.read(judges_[i].normal);
            for (int half = 0; half < 2; ++half) estimates.half[half][i] = lookup.irradiance(i, layout_, volume.history(half), coefficients);
        });
    }

    template <class Body>
    void forReceivers(std::size_t count, Body&& body) const {
        constexpr std::size_t kPiece = LookupTable::kPiece;
        parallelFor_((count + kPiece - 1) / kPiece, [&](std::size_t piece) {
            for (std::size_t i = piece * kPiece; i < std::min(count, (piece + 1) * kPiece); ++i) body(i);
        });
    }

    // Points, judges and surfaces stand still: their weights are found once a level.
    struct Lookups {
        LookupTable points, judges, surfaces;
    };
    Lookups makeLookups(const Level& level) const {
        return {{level, points_, {}, parallelFor_}, {level, judges_, {}, parallelFor_}, {level, surfaces_.receivers, {}, parallelFor_}};
    }

    // Volumes that hold light, and how they are read.
    struct Lit {
        const StillLighting* lighting;
        const std::vector<Lookups>* lookups;  // a level each
        LevelMix mix;
    };

    // The chosen levels, mixed: E at receivers is added to `sum`, times `scale`.
    void read(const Lit& lit, LookupTable Lookups::*which, std::span<const ClvReceiver> receivers, float scale, std::span<glm::vec3> sum) const {
        forReceivers(receivers.size(), [&](std::size_t i) {
            const ClvCoefficients coefficients = layout_.read(receivers[i].normal);
            for (std::size_t l = 0; l < lit.lighting->volumes().size(); ++l) {
                if (lit.mix[l] == 0.0) continue;
                const Volume& volume = lit.lighting->volumes()[l];
                const int halves = volume.parts().halves;
                for (int half = 0; half < halves; ++half) {
                    sum[i] += ((*lit.lookups)[l].*which).irradiance(i, layout_, volume.history(half), coefficients) * (scale * float(lit.mix[l]) / float(halves));
                }
            }
        });
    }
    void evaluate(const Lit& lit, std::span<glm::vec3> out, float scale = 1.0f) {
        clock_.time("evaluate", [&] { read(lit, &Lookups::points, points_, scale, out); });
    }

    // Surfaces send on what the volume says they receive; the sum over the surfaces is set to what the rays brought there, so that no
    // error of the volume's total grows from bounce to bounce.
    bool emitFrom(const Lit& lit, const glm::dvec3& power, TexelSampler& sampler) {
        bool any = false;
        clock_.time("rsm", [&] {
            std::vector<glm::vec3> irradiance(surfaces_.receivers.size(), glm::vec3(0.0f));
            read(lit, &Lookups::surfaces, surfaces_.receivers, 1.0f, irradiance);
            emitters_.assign((irradiance.size() + kTexelWidth - 1) / kTexelWidth * kTexelWidth, ClvRsmTexel{});
            glm::dvec3 sum(0.0);
            for (std::size_t k = 0; k < irradiance.size(); ++k) sum += glm::dvec3(surfaces_.albedo[k] * irradiance[k]) * double(surfaces_.area);
            vec3 correction(0.0f);
            for (int c = 0; c < 3; ++c) correction[c] = sum[c] > 0.0 ? float(power[c] / sum[c]) : 0.0f;
            for (std::size_t k = 0; k < irradiance.size(); ++k) {
                const vec3 flux = surfaces_.albedo[k] * irradiance[k] * (correction * surfaces_.area);
                emitters_[k] = {surfaces_.receivers[k].position, 0.0f, surfaces_.receivers[k].normal, 1u, flux, 0.0f};
                any = any || flux.x + flux.y + flux.z > 0.0f;
            }
            sampler.build(emitters_, kTexelWidth, parallelFor_);
        });
        return any;
    }

    Lit firstLight() const { return {lighting_.get(), &lookups_, mix_}; }

    // Further bounces have fewer rays and smoother light than the first: where the resolution is not given, they get a coarser level
    // that keeps its noise as low.
    Level furtherLevel(double rays) {
        if (!automatic_) return lighting_->volumes().front().level();
        return makeLevel(rays < kRaysForMiddle ? kResolutions[0] : rays < kRaysForFine ? kResolutions[1] : kResolutions[2]);
    }

    static double total(const glm::dvec3& v) { return v.x + v.y + v.z; }

    void furtherBounces(std::span<glm::vec3> out) {
        Progress progress("bounces");
        // The power that goes from bounce to bounce falls by about this factor.
        double ratio = total(sent_) > 0.0 ? total(sentOn_) / total(sent_) : 0.0;
        glm::dvec3 power = sentOn_;
        const double first = total(power);
        const double expected = std::clamp(ratio, 0.02, 0.98);
        const double spread = (1.0 - std::pow(expected, kMostSweeps - 1)) / (1.0 - expected);
        const double budget = options_.seconds > 0.0 ? double(report_.rays) : double(options_.rays - std::min(options_.rays, report_.rays));
        const Level level = furtherLevel(budget);
        std::vector<Lookups> lookups;
        clock_.time("setup", [&] { lookups.push_back(makeLookups(level)); });
        // Two volumes in turn: one is read while the other is filled.
        std::unique_ptr<StillLighting> pair[2];
        Lit source = firstLight();
        TexelSampler sampler;
        for (int sweep = 2; sweep <= kMostSweeps; ++sweep) {
            const double left = ratio < 1.0 ? total(power) / (1.0 - ratio) : total(power);
            if (!(total(power) > 0.0) || left < kNegligible * first) return;
            if (!emitFrom(source, power, sampler)) return;
            std::unique_ptr<StillLighting>& target = pair[sweep % 2];
            const std::size_t count = std::max<std::size_t>(1, std::size_t(budget * std::pow(expected, sweep - 2) / spread));
            if (!target) {
                target = makeLighting(target, 1, count, 0x100u + std::uint32_t(sweep % 2));
                report_.bytes += target->addLevel(level).bytes();
            }
            Volume& volume = target->volumes().front();
            volume.reset();
            for (std::size_t done = 0; done < count;) {
                const std::size_t round = trace(*target, sampler, std::min(count - done, kLargestRound));
                inject(*target, volume);
                const auto [flux, on] = sentOn(*target);
                nextPower_ = done == 0 ? on : (nextPower_ * double(done) + on * double(round)) / double(done + round);
                done += round;
            }
            report_.sweeps = std::uint32_t(sweep);
            ratio = total(nextPower_) / total(power);
            // Behind the last sweep every further one has about the same shape, fainter by the ratio: a geometric series.
            const bool last = sweep == kMostSweeps || total(nextPower_) < kNegligible * (1.0 - std::min(ratio, 0.999)) * first;
            float scale = 1.0f;
            if (last && ratio < kLargestRatio) scale = float(1.0 / (1.0 - ratio));
            if (last && ratio >= kLargestRatio) {
                report_.warnings.push_back(fmt::format(
                    "bounce {} still carries {:.4f} of the power of the one before: surfaces reflect all light and nothing absorbs it, so "
                    "there is no finite answer; what is given is the light of the first {} bounces",
                    sweep, ratio, sweep));
            }
            source = {target.get(), &lookups, {1.0}};
            evaluate(source, out, scale);
            if (last) return;
            power = nextPower_;
            progress.update(1.0 - total(power) / first);
        }
    }

    // Rays of all further bounces from which on they get the second and the third of kResolutions.
    static constexpr double kRaysForMiddle = 1e6, kRaysForFine = 32e6;
    // Above this ratio from bounce to bounce the sum has no stable limit.
    static constexpr double kLargestRatio = 0.9995;

    const Scene& scene_;
    const LightOptions& options_;
    std::uint32_t seed_;
    const ParallelFor& parallelFor_;
    std::vector<ClvReceiver> points_, judges_;
    const Needs needs_;
    const bool automatic_;  // the resolution is chosen here
    const DepositLayout layout_;
    StageClock clock_;
    PipelineReport report_;
    std::optional<EmbreeScene> embree_, proxy_;
    std::optional<Scene> proxyScene_;
    std::optional<LightTexels> texels_;
    SurfaceSamples surfaces_;
    std::optional<RayGuide> guide_;
    std::unique_ptr<StillLighting> lighting_;
    std::vector<int> resolutions_;
    LevelMix mix_{};
    bool settled_ = false;  // no further level joins
    std::vector<Lookups> lookups_;
    std::vector<HalfEstimates> estimates_;
    std::size_t pilots_ = 0;
    std::vector<ClvRay> pilotRays_;
    std::vector<ClvHit> hits_;
    std::vector<ClvRsmTexel> emitters_;
    glm::dvec3 sent_{0.0}, sentOn_{0.0}, nextPower_{0.0};
};

}  // namespace

PipelineReport lightPoints(const Scene& scene, const LightOptions& options, std::uint32_t seed, const ParallelFor& parallelFor,
                           std::span<const ReferencePoint> points, std::span<glm::vec3> out) {
    return LightRun(scene, options, seed, parallelFor, points).run(out);
}

void reportLight(const PipelineReport& run, Report& report) {
    Report levels = Report::array();
    for (const auto& [resolution, weight] : run.levels) levels.push_back({{"resolution", resolution}, {"weight", weight}});
    report["levels"] = levels;
    report["rays"] = run.rays;
    report["sweeps"] = run.sweeps;
    report["channels"] = run.channels;
    report["share_of_rays_that_meet"] = run.shareThatMeets;
    report["guided"] = run.guided;
    report["slots"] = run.slots;
    report["bytes"] = run.bytes;
    Report stages = Report::object();
    for (const auto& [name, seconds] : run.stages) stages[name + "_ms"] = 1e3 * seconds;
    report["stages"] = stages;
    report["frame_ms"] = 1e3 * run.frameSeconds;
    if (!run.warnings.empty()) report["warnings"] = run.warnings;
    for (const std::string& warning : run.warnings) fmt::print(stderr, "clv: {}\n", warning);
}

}  // namespace clv
