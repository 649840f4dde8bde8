#include "benchmarks/baselines/light_volume.h"

#include <algorithm>
#include <bit>
#include <optional>

#include <fmt/format.h>

#include "bindings/embree/light_maps.h"
#include "bindings/embree/visible_points.h"
#include "bindings/scene/scene_facts.h"
#include "clv/cpu/build_level.h"
#include "clv/cpu/lookup_table.h"
#include "clv/cpu/resolution.h"
#include "clv/cpu/still_lighting.h"

namespace clv {
namespace {

constexpr int kResolutions[] = {16, 32, 64, 128};  // that the library chooses from
constexpr std::size_t kMostPilots = 64 << 10;      // rays that show where light goes
constexpr std::size_t kPilotShare = 8;             // one ray in so many
constexpr std::size_t kJudges = 1024;              // receivers that choose the resolution
constexpr std::size_t kPiece = LookupTable::kPiece;

std::string storageName(unsigned storage) {
    const char* names[] = {"cube", "cube9", "sh1", "sh2"};
    return names[storage];
}

// A level as it is before there is light, and how receivers read it.
struct BuiltLevel {
    int resolution;
    Level level;
    LookupTable points, judges;
};

// A level in play: its light, and its weight in what is shown.
struct LitLevel {
    const BuiltLevel* built;
    Volume* volume;
    double weight = 1.0;
};

class LightVolume : public Method {
public:
    explicit LightVolume(const LightVolumeSettings& settings) : settings_(settings) {}

    std::string name() const override { return "clv"; }
    MethodSettings settings() const override {
        return {{"resolution", automatic() ? "chosen" : std::to_string(settings_.resolution)},
                {"storage", storageName(settings_.storage)},
                {"grid_shift", gridShiftText(settings_.gridShift)},
                {"readers", readersName(settings_.readers)},
                {"weights", settings_.keptWeights ? "kept" : "at each reading"},
                {"planned_rays", std::to_string(settings_.plannedRays)}};
    }

    void prepare(const MethodWorld& world, std::span<const ReferencePoint> receivers) override {
        world_.emplace(world);
        const Needs needs = planNeeds(sceneFacts(world.scene.scene()));
        layout_ = {settings_.storage, needs.channels, needs.frame};
        parts_ = {.halves = automatic() ? 2 : 1, .chunks = automatic() ? 1 : 2};
        for (const ReferencePoint& p : receivers) points_.push_back({p.position, 0.0f, p.normal, 0.0f});
        if (automatic()) judges_ = visiblePoints(world.scene, kJudges, 1);
        std::vector<ClvReceiver> readers = readingPoints(settings_.readers, world, receivers);
        if (settings_.readers != Readers::anywhere) readers.insert(readers.end(), judges_.begin(), judges_.end());
        if (automatic()) {
            for (int resolution : kResolutions) build(resolution, readers);
        } else {
            build(settings_.resolution, readers);
        }
        restart(1);
    }

    void restart(std::uint32_t seed) override {
        seed_ = seed;
        pass_ = 0;
        rays_ = traced_ = 0;
        settled_ = !automatic();
        guide_.reset();
        lit_.clear();
        maps_.emplace(world_->scene, clvHashCombine(seed, 0x3u), world_->parallelFor);
        StillLightingSettings still;
        still.layout = layout_, still.parts = parts_;
        still.seed = seed, still.originOffset = world_->scene.surfaceOffset();
        lighting_.emplace(still, [scene = &world_->scene](std::span<ClvRay> rays) { scene->trace(rays); }, world_->parallelFor);
        addLevel();
        if (automatic()) addLevel();
    }

    void renderMaps() override { sampler_.build(maps_->render(pass_++), maps_->side(), world_->parallelFor, guide()); }

    void frame(std::size_t rays) override {
        std::size_t left = rays;
        if (rays_ == 0) {
            left -= pilot(rays);
            planned_ = std::max(settings_.plannedRays, left);
        }
        while (left > 0) {
            // While levels are judged all of them are filled, so that ends with about the first third of the rays.
            const std::size_t judged = std::bit_floor(std::max<std::size_t>(planned_ / 3, 1));
            const std::size_t count = settled_ ? left : std::min(left, judged - std::min(rays_, judged - 1));
            shoot(count);
            left -= count;
            if (lit_.size() > 1) judge(rays_ >= judged);
        }
    }

    void irradiance(std::span<glm::vec3> out) override {
        std::fill(out.begin(), out.end(), vec3(0.0f));
        forReceivers(out.size(), [&](std::size_t i) {
            const ClvCoefficients read = layout_.read(points_[i].normal);
            for (const LitLevel& level : lit_) {
                if (level.weight == 0.0) continue;
                const float weight = float(level.weight / parts_.halves);
                SlotWeights found;
                if (!settings_.keptWeights) lookupWeights(level.built->level, points_[i], {}, found);
                for (int half = 0; half < parts_.halves; ++half) {
                    const auto history = level.volume->history(half);
                    out[i] += weight * (settings_.keptWeights ? level.built->points.irradiance(i, layout_, history, read)
                                                              : readIrradiance(layout_, history, found, read));
                }
            }
        });
    }

    std::size_t bytes() const override {
        std::size_t sum = 0;
        for (const LitLevel& level : lit_) sum += level.volume->bytes() + level.built->points.bytes() + level.built->judges.bytes();
        return sum;
    }
    std::uint64_t raysTraced() const override { return traced_; }

private:
    bool automatic() const { return settings_.resolution == 0; }
    const RayGuide* guide() const { return guide_ && guide_->worthwhile() ? &*guide_ : nullptr; }

    template <class Body>
    void forReceivers(std::size_t count, const Body& body) const {
        world_->parallelFor((count + kPiece - 1) / kPiece, [&](std::size_t piece) {
            for (std::size_t i = piece * kPiece; i < std::min(count, (piece + 1) * kPiece); ++i) body(i);
        });
    }

    void build(int resolution, std::span<const ClvReceiver> readers) {
        const Bounds& bounds = world_->scene.scene().bounds;
        const ClvVolume volume = volumeOverBounds(bounds.lo, bounds.hi, resolution, settings_.storage, settings_.gridShift);
        const auto needed = settings_.readers == Readers::anywhere ? std::vector<std::uint8_t>() : neededCells(volume, readers);
        BuiltLevel& built = built_.emplace_back(BuiltLevel{resolution, buildLevel(volume, world_->scene.probe(), needed, world_->parallelFor), {}, {}});
        if (settings_.keptWeights) built.points = LookupTable(built.level, points_, {}, world_->parallelFor);
        built.judges = LookupTable(built.level, judges_, {}, world_->parallelFor);
    }

    // The next finer level joins those in play, still without light.
    LitLevel& addLevel() {
        const std::size_t next = lit_.empty() ? 0 : std::size_t(lit_.back().built - built_.data()) + 1;
        return lit_.emplace_back(LitLevel{&built_[next], &lighting_->addLevel(built_[next].level)});
    }

    // A few rays show where light goes; where much of it leaves the scene, the others are guided. Returns their number.
    std::size_t pilot(std::size_t rays) {
        std::vector<ClvRay> pilots(std::min(kMostPilots, rays / kPilotShare));
        constexpr std::size_t kPilotPiece = 2048;
        world_->parallelFor((pilots.size() + kPilotPiece - 1) / kPilotPiece, [&](std::size_t piece) {
            const auto part = std::span(pilots).subspan(piece * kPilotPiece, std::min(kPilotPiece, pilots.size() - piece * kPilotPiece));
            makeRays(sampler_, uint(piece * kPilotPiece), clvHashCombine(seed_, 0x7u), world_->scene.surfaceOffset(), part);
            world_->scene.trace(part);
        });
        const Bounds& bounds = world_->scene.scene().bounds;
        guide_.emplace(bounds.lo, bounds.hi);
        guide_->learn(pilots);
        guide_->finish();
        traced_ += pilots.size();
        if (guide()) {
            --pass_;
            renderMaps();
        }
        return pilots.size();
    }

    void shoot(std::size_t count) {
        lighting_->rays(sampler_, count);
        lighting_->trace();
        for (const LitLevel& level : lit_) add(level);
        rays_ += lighting_->currentRays().size();
        traced_ += lighting_->currentRays().size();
    }
    // The rays of the last shot into one level.
    void add(const LitLevel& level) {
        lighting_->inject(*level.volume);
        lighting_->merge(*level.volume);
    }

    // Foretells the errors of the levels once all planned rays are in, and mixes the best. Until this is settled a finer level joins
    // while the finest is the best; then levels that err clearly more are dropped.
    void judge(bool settled) {
        LevelErrors errors = foretoldErrors();
        while (!settled_ && bestLevel(errors) + 1 == errors.count && lit_.back().built != &built_.back()) {
            add(addLevel());
            errors = foretoldErrors();
        }
        const LevelMix mix = chooseLevels(errors);
        for (std::size_t l = 0; l < lit_.size(); ++l) lit_[l].weight = mix[l];
        settled_ = settled_ || settled;
        for (int l = settled_ ? errors.count : 0; l-- > 0;) {
            if (lit_[std::size_t(l)].weight == 0.0 && !staysInPlay(errors, l)) lit_.erase(lit_.begin() + l);
        }
    }
    LevelErrors foretoldErrors() const {
        std::vector<HalfEstimates> estimates(lit_.size());
        std::vector<double> factor;
        for (std::size_t l = 0; l < lit_.size(); ++l) {
            const LitLevel& level = lit_[l];
            for (auto& half : estimates[l].half) half.resize(judges_.size());
            forReceivers(judges_.size(), [&](std::size_t i) {
                const ClvCoefficients read = layout_.read(judges_[i].normal);
                for (int half = 0; half < 2; ++half) estimates[l].half[half][i] = level.built->judges.irradiance(i, layout_, level.volume->history(half), read);
            });
            // A level that joined late has missed the rays before it.
            const double missed = double(rays_) - level.volume->rays();
            factor.push_back(std::max(1.0, (double(planned_) - missed) / level.volume->rays()));
        }
        return judgeLevels(estimates).withRays(factor);
    }

    const LightVolumeSettings settings_;
    std::optional<MethodWorld> world_;
    DepositLayout layout_;
    VolumeParts parts_;
    std::vector<ClvReceiver> points_, judges_;
    std::vector<BuiltLevel> built_;  // coarse to fine

    std::uint32_t seed_ = 1, pass_ = 0;
    std::optional<LightMaps> maps_;
    std::optional<RayGuide> guide_;
    TexelSampler sampler_;
    std::optional<StillLighting> lighting_;
    std::vector<LitLevel> lit_;  // in play, coarse to fine
    std::size_t rays_ = 0, planned_ = 0;  // without pilots
    std::uint64_t traced_ = 0;
    bool settled_ = true;  // the resolutions in play are chosen
};

}  // namespace

std::unique_ptr<Method> makeLightVolume(const LightVolumeSettings& settings) {
    return std::make_unique<LightVolume>(settings);
}

}  // namespace clv
