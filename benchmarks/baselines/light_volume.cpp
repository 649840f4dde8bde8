#include "benchmarks/baselines/light_volume.h"

#include <algorithm>
#include <bit>
#include <optional>

#include <fmt/format.h>

#include "bindings/embree/light_maps.h"
#include "bindings/embree/visible_points.h"
#include "bindings/scene/scene_facts.h"
#include "clv/cpu/build_level.h"
#include "clv/cpu/level_choice.h"
#include "clv/cpu/lookup_table.h"
#include "clv/cpu/still_lighting.h"

namespace clv {
namespace {

constexpr std::size_t kMostPilots = 64 << 10;      // rays that show where light goes
constexpr std::size_t kPilotShare = 8;             // one ray in so many
constexpr std::size_t kLeastPilots = 2 << 10;      // fewer show too little, and a guide costs what thousands of rays do
constexpr std::size_t kJudges = 1024;              // receivers that choose the resolution

std::string storageName(unsigned storage) {
    const char* names[] = {"cube", "cube9", "sh1", "sh2"};
    return names[storage];
}

std::string lookupName(unsigned lookup) {
    const char* names[] = {"nearest", "trilinear", "linear fit"};
    return names[lookup];
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
    AlignedFloats mean{};  // of both halves, where there are two
};

class LightVolume : public Method, private LevelsInPlay {
public:
    explicit LightVolume(const LightVolumeSettings& settings) : settings_(settings) {}

    std::string name() const override { return "clv"; }
    MethodSettings settings() const override {
        return {{"resolution", automatic() ? "chosen" : std::to_string(settings_.resolution)},
                {"storage", storageName(settings_.storage)},
                {"grid_shift", gridShiftText(settings_.gridShift)},
                {"readers", readersName(settings_.readers)},
                {"lookup", lookupName(settings_.lookup)},
                {"guided", settings_.guided ? "yes" : "no"},
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
        choice_ = {};
        guide_.reset();
        lit_.clear();
        maps_.emplace(world_->scene, clvHashCombine(seed, 0x3u), world_->parallelFor);
        StillLightingSettings still;
        still.layout = layout_, still.parts = parts_;
        still.seed = seed, still.originOffset = world_->scene.surfaceOffset();
        lighting_.emplace(still, [scene = &world_->scene](std::span<ClvRay> rays) { scene->trace(rays); }, world_->parallelFor);
        lighting_->reserveRays(mostRays_);
        // Where the library chooses, those that one of its first two may be: the first frame says how many rays there are.
        for (int k = 0; k < (automatic() ? 3 : 1); ++k) addLevel();
    }

    void renderMaps() override {
        texels_ = maps_->render(pass_++);
        pickTexels();
    }

    void frame(std::size_t rays) override {
        std::size_t left = rays;
        if (rays_ == 0) {
            left -= pilot(rays);
            planned_ = std::max(settings_.plannedRays, left);
            if (automatic()) keepFirst(std::max(settings_.plannedRays, rays));
        }
        while (left > 0) {
            // While levels are judged all of them are filled, so that ends with about the first third of the rays.
            const std::size_t judged = std::bit_floor(std::max<std::size_t>(planned_ / 3, 1));
            const std::size_t count = isSettled() ? left : std::min(left, judged - std::min(rays_, judged - 1));
            shoot(count);
            left -= count;
            if (automatic()) choice_.judge(*this, double(rays_), double(planned_), rays_ >= judged);
        }
        if (parts_.halves == 1) return;
        for (LitLevel& level : lit_) {
            if (level.weight > 0.0) averageHalves(level.volume->history(0), level.volume->history(1), world_->parallelFor, level.mean);
        }
    }

    void irradiance(std::span<glm::vec3> out) override {
        std::fill(out.begin(), out.end(), vec3(0.0f));
        if (rays_ == 0) return;
        forReceivers(out.size(), [&](std::size_t i) {
            const ClvCoefficients read = layout_.read(points_[i].normal);
            for (const LitLevel& level : lit_) {
                if (level.weight == 0.0) continue;
                SlotWeights found;
                if (!settings_.keptWeights) lookupWeights(level.built->level, points_[i], lookup_, found);
                const std::span<const float> light = shownLight(level);
                out[i] += float(level.weight) * (settings_.keptWeights ? level.built->points.irradiance(i, layout_, light, read) : readIrradiance(layout_, light, found, read));
            }
        });
    }

    std::size_t bytes() const override {
        std::size_t sum = 0;
        for (const LitLevel& level : lit_) sum += level.volume->bytes() + level.mean.size() * sizeof(float) + level.built->points.bytes() + level.built->judges.bytes();
        return sum;
    }
    std::uint64_t raysTraced() const override { return traced_; }

private:
    bool automatic() const { return settings_.resolution == 0; }
    bool isSettled() const { return !automatic() || choice_.settled(); }
    const RayGuide* guide() const { return guide_ && guide_->worthwhile() ? &*guide_ : nullptr; }

    template <class Body>
    void forReceivers(std::size_t count, const Body& body) const {
        forPieces(*world_, count, LookupTable::kPiece, body);
    }

    void build(int resolution, std::span<const ClvReceiver> readers) {
        const Bounds& bounds = world_->scene.scene().bounds;
        const ClvVolume volume = volumeOverBounds(bounds.lo, bounds.hi, resolution, settings_.storage, settings_.gridShift);
        const auto needed = settings_.readers == Readers::anywhere ? std::vector<std::uint8_t>() : neededCells(volume, readers);
        BuiltLevel& built = built_.emplace_back(BuiltLevel{resolution, buildLevel(volume, world_->scene.probe(), needed, world_->parallelFor), {}, {}});
        if (settings_.keptWeights) built.points = LookupTable(built.level, points_, lookup_, world_->parallelFor);
        built.judges = LookupTable(built.level, judges_, lookup_, world_->parallelFor);
    }

    // The next finer level joins those in play, still without light.
    LitLevel& addLevel() {
        const std::size_t next = lit_.empty() ? 0 : std::size_t(lit_.back().built - built_.data()) + 1;
        // One that waited for the first frame in vain has its memory already.
        Volume& volume = next < lighting_->volumes().size() ? lighting_->volumes()[next] : lighting_->addLevel(built_[next].level);
        return lit_.emplace_back(LitLevel{&built_[next], &volume});
    }

    // Of the levels that wait for the first frame, the two to begin with.
    void keepFirst(std::size_t planned) {
        const int first = resolutionsFor(double(planned), settings_.lookup).front();
        if (lit_.front().built->resolution < first) lit_.erase(lit_.begin());
        lit_.erase(lit_.begin() + 2, lit_.end());
    }

    void pickTexels() { sampler_.build(texels_, maps_->side(), world_->parallelFor, guide()); }

    // A few rays show where light goes; where much of it leaves the scene, the others are guided. Returns their number.
    std::size_t pilot(std::size_t rays) {
        if (!settings_.guided || rays < kLeastPilots * kPilotShare) return 0;
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
        if (guide()) pickTexels();
        return pilots.size();
    }

    void shoot(std::size_t count) {
        lighting_->rays(sampler_, count);
        lighting_->trace();
        for (const LitLevel& level : lit_) add(level);
        mostRays_ = std::max(mostRays_, count);
        rays_ += lighting_->currentRays().size();
        traced_ += lighting_->currentRays().size();
    }
    // The rays of the last shot into one level.
    void add(const LitLevel& level) {
        lighting_->inject(*level.volume);
        lighting_->merge(*level.volume);
    }

    int count() const override { return int(lit_.size()); }
    double rays(int level) const override { return lit_[std::size_t(level)].volume->rays(); }
    void estimate(int which, HalfEstimates& estimates) const override {
        const LitLevel& level = lit_[std::size_t(which)];
        for (auto& half : estimates.half) half.resize(judges_.size());
        forReceivers(judges_.size(), [&](std::size_t i) {
            const ClvCoefficients read = layout_.read(judges_[i].normal);
            for (int half = 0; half < 2; ++half) estimates.half[half][i] = level.built->judges.irradiance(i, layout_, level.volume->history(half), read);
        });
    }
    bool addFiner() override {
        if (lit_.back().built == &built_.back()) return false;
        add(addLevel());
        return true;
    }
    void setWeight(int level, double weight) override { lit_[std::size_t(level)].weight = weight; }
    void drop(int level) override { lit_.erase(lit_.begin() + level); }

    std::span<const float> shownLight(const LitLevel& level) const { return parts_.halves == 1 ? level.volume->history(0) : std::span<const float>(level.mean); }

    const LightVolumeSettings settings_;
    const LookupOptions lookup_{.lookup = settings_.lookup};
    std::optional<MethodWorld> world_;
    DepositLayout layout_;
    VolumeParts parts_;
    std::vector<ClvReceiver> points_, judges_;
    std::vector<BuiltLevel> built_;  // coarse to fine

    std::uint32_t seed_ = 1, pass_ = 0;
    std::optional<LightMaps> maps_;
    std::optional<RayGuide> guide_;
    std::span<const ClvRsmTexel> texels_;
    TexelSampler sampler_;
    std::optional<StillLighting> lighting_;
    std::vector<LitLevel> lit_;  // in play, coarse to fine
    std::size_t rays_ = 0, planned_ = 0;  // without pilots
    std::size_t mostRays_ = 0;            // at once, in earlier runs: no frame has to take their memory
    std::uint64_t traced_ = 0;
    LevelChoice choice_;
};

}  // namespace

std::unique_ptr<Method> makeLightVolume(const LightVolumeSettings& settings) {
    return std::make_unique<LightVolume>(settings);
}

}  // namespace clv
