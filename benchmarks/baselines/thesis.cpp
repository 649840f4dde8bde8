#include "benchmarks/baselines/thesis.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "bindings/embree/light_maps.h"
#include "clv/cpu/build_level.h"
#include "clv/cpu/evaluate.h"
#include "clv/cpu/frame_rays.h"

namespace clv {
namespace {

// What the scale is fitted to: receivers, paths for the truth at each, frames of rays.
constexpr std::size_t kFitReceivers = 500;
constexpr std::uint64_t kFitPaths = 512;
constexpr int kFitFrames = 8;
constexpr std::size_t kFitRays = 128 << 10;

class Thesis : public Method {
public:
    explicit Thesis(const ThesisSettings& settings) : settings_(settings) {}

    std::string name() const override { return "thesis"; }
    MethodSettings settings() const override {
        return {{"resolution", std::to_string(settings_.resolution)},
                {"grid_shift", gridShiftText(settings_.gridShift)},
                {"blend", fmt::format("{:g}", settings_.blend)}};
    }

    void prepare(const MethodWorld& world, std::span<const ReferencePoint> receivers) override {
        world_.emplace(world);
        const Bounds& bounds = world.scene.scene().bounds;
        const ClvVolume volume = volumeOverBounds(bounds.lo, bounds.hi, settings_.resolution, layout_.storage, settings_.gridShift);
        // Cells as a texture has them: dense, and blind to the geometry.
        level_ = buildLevel(volume, world.scene.probe(), {}, world.parallelFor, {.findRegions = false});
        for (PartialVolume& partial : partials_) partial.resize(level_.slots.size(), layout_, false);
        receivers_.assign(receivers.begin(), receivers.end());
        fitScale();
        restart(1);
    }

    void restart(std::uint32_t seed) override {
        frames_ = 0;
        traced_ = 0;
        maps_.emplace(world_->scene, clvHashCombine(seed, 0x3u), world_->parallelFor);
        rays_.emplace(parts_, seed, world_->scene.surfaceOffset());
        rays_->reserve(mostRays_);
        history_.assign(level_.slots.size() * layout_.stride(), 0.0f);
    }

    void renderMaps() override { sampler_.build(maps_->render(frames_), maps_->side(), world_->parallelFor); }

    void frame(std::size_t rays) override { addFrame(rays, frames_ == 0 ? 1.0f : settings_.blend); }

    void irradiance(std::span<glm::vec3> out) override {
        forPieces(*world_, out.size(), 256, [&](std::size_t i) { out[i] = scale_ * read(receivers_[i]); });
    }

    std::size_t bytes() const override { return layout_.bytes(level_.slots.size()) * (partials_.size() + 1); }
    std::uint64_t raysTraced() const override { return traced_; }

private:
    void addFrame(std::size_t rays, float share) {
        ++frames_;
        rays_->draw(sampler_, rays, world_->parallelFor);
        rays_->trace([this](std::span<ClvRay> part) { world_->scene.trace(part); }, world_->parallelFor);
        traced_ += rays_->all().size();
        mostRays_ = std::max(mostRays_, rays);
        world_->parallelFor(partials_.size(), [&](std::size_t part) { inject(level_, layout_, kClvInjectThesis, rays_->part(part), partials_[part].target()); });
        const std::size_t stride = layout_.stride();
        forPieces(*world_, level_.slots.size(), 2048, [&](std::size_t slot) {
            mergeDeposits(partials_, slot, stride, 1.0f / float(rays_->all().size()), share, history_.data() + slot * stride);
        });
    }

    // W: what the nearest cell holds for a receiver's normal, still without the scale. Half a cell in front of the surface lies the cell
    // with the least of what is behind it.
    vec3 read(const ReferencePoint& receiver) const {
        const ClvVolume& volume = level_.volume;
        const vec3 position = receiver.position + receiver.normal * (kClvLookupOffset * volume.cellSize);
        const uint slot = level_.table[clvCellIndex(volume, clvClampCell(volume, clvCellFromPosition(volume, position)))];
        const float whole = 1.0f;
        return readIrradiance(layout_, history_, std::span(&slot, 1), std::span(&whole, 1), clvReadCoefficientsSquared(receiver.normal));
    }

    // The scale with the least squared error at some of the receivers, once the light has converged.
    void fitScale() {
        std::vector<ReferencePoint> chosen;
        for (std::size_t k = 0; k < std::min(kFitReceivers, receivers_.size()); ++k) {
            chosen.push_back(receivers_[k * receivers_.size() / std::min(kFitReceivers, receivers_.size())]);
        }
        std::vector<ReferenceResult> truth(chosen.size());
        referenceIrradiance(world_->scene, chosen, {.samplesPerPoint = kFitPaths}, world_->parallelFor, truth);
        restart(0);
        for (int k = 1; k <= kFitFrames; ++k) {
            renderMaps();
            addFrame(kFitRays, 1.0f / float(k));
        }
        double product = 0.0, square = 0.0;
        for (std::size_t i = 0; i < chosen.size(); ++i) {
            const glm::dvec3 value(read(chosen[i]));
            product += glm::dot(value, glm::dvec3(truth[i].irradiance));
            square += glm::dot(value, value);
        }
        scale_ = square > 0.0 ? float(product / square) : 0.0f;
    }

    const ThesisSettings settings_;
    const DepositLayout layout_{.storage = kClvStorageCube};
    const VolumeParts parts_{.halves = 1, .chunks = 2};
    std::optional<MethodWorld> world_;
    std::vector<ReferencePoint> receivers_;
    Level level_;
    float scale_ = 0.0f;  // 1/m^2

    std::optional<LightMaps> maps_;
    TexelSampler sampler_;
    std::optional<FrameRays> rays_;
    std::vector<PartialVolume> partials_{std::size_t(parts_.chunks)};
    AlignedFloats history_;  // W, a record a cell
    std::uint32_t frames_ = 0;
    std::uint64_t traced_ = 0;
    std::size_t mostRays_ = 0;  // at once, in earlier runs: no frame has to take their memory
};

}  // namespace

std::unique_ptr<Method> makeThesis(const ThesisSettings& settings) {
    return std::make_unique<Thesis>(settings);
}

}  // namespace clv
