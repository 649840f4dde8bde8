#include "bindings/cli/cpu_lighting.h"

#include "bindings/cli/light_walk.h"
#include "bindings/cli/scene_facts.h"
#include "bindings/embree/light_maps.h"
#include "clv/cpu/still_lighting.h"

namespace clv {
namespace {

class CpuLevel : public LightLevel {
public:
    CpuLevel(Level level, const DepositLayout& layout, const VolumeParts& parts) : volume(std::move(level), layout, parts) {}
    const Level& level() const override { return volume.level(); }
    double rays() const override { return volume.rays(); }
    std::size_t bytes() const override { return volume.bytes(); }
    std::vector<std::span<const float>> histories() override {
        std::vector<std::span<const float>> halves;
        for (int half = 0; half < volume.parts().halves; ++half) halves.push_back(volume.history(half));
        return halves;
    }

    Volume volume;
};

class CpuLighting : public Lighting {
public:
    CpuLighting(const LightingSettings& settings, const EmbreeScene& scene, const EmbreeScene& target, std::uint32_t mapSeed, const ParallelFor& parallelFor, StageClock& clock)
        : settings_(settings), parts_(volumeParts(settings.halves, settings.rays)), scene_(scene), target_(target), parallelFor_(parallelFor), clock_(clock),
          maps_(scene, mapSeed, parallelFor), lighting_(stillSettings(), [this](std::span<ClvRay> rays) { cut(rays); }, parallelFor) {
        lighting_.reserveRays(settings.firstShot);
    }

    void renderMaps(std::uint32_t pass) override {
        clock_.time("rsm", [&] { sampler_.build(maps_.render(pass), maps_.side(), parallelFor_, guide_); });
    }
    void emit(std::span<const ClvRsmTexel> emitters) override {
        clock_.time("rsm", [&] { sampler_.build(emitters, kEmitterWidth, parallelFor_); });
    }

    void draw(std::uint32_t seed, std::span<ClvRay> rays, std::span<ClvHit> hits) override {
        constexpr std::size_t kPiece = 2048;
        parallelFor_((rays.size() + kPiece - 1) / kPiece, [&](std::size_t piece) {
            const std::size_t first = piece * kPiece, count = std::min(kPiece, rays.size() - first);
            const auto part = rays.subspan(first, count);
            makeRays(sampler_, uint(first), seed, scene_.surfaceOffset(), part);
            hits.empty() ? target_.trace(part) : target_.trace(part, hits.subspan(first, count));
        });
    }
    void guideBy(const RayGuide& guide) override { guide_ = &guide; }

    std::unique_ptr<LightLevel> makeLevel(Level level) override { return std::make_unique<CpuLevel>(std::move(level), settings_.layout, parts_); }

    std::size_t shoot(std::size_t count, std::span<LightLevel* const> levels) override {
        clock_.time("rays", [&] { lighting_.rays(sampler_, count); });
        if (settings_.keepHits) hits_.resize(std::max(hits_.size(), lighting_.currentRays().size()));
        clock_.time("trace", [&] { lighting_.trace(); });
        for (LightLevel* level : levels) shootAgain(*level);
        return lighting_.currentRays().size();
    }
    void shootAgain(LightLevel& level) override {
        Volume& volume = static_cast<CpuLevel&>(level).volume;
        clock_.time("inject", [&] { lighting_.inject(volume); });
        clock_.time("merge", [&] { lighting_.merge(volume); });
    }
    LitPlaces takeLit(int half) override {
        const std::size_t perHalf = lighting_.currentRays().size() / std::size_t(parts_.halves), first = std::size_t(half) * perHalf;
        LitPlaces lit;
        addLit(lighting_.currentRays().subspan(first, perHalf), std::span(hits_).subspan(first, perHalf), 1.0f / float(perHalf), lit);
        return lit;
    }
    void add(std::span<const ClvRay> rays, LightLevel& level) override {
        if (rays.empty()) return;
        Volume& volume = static_cast<CpuLevel&>(level).volume;
        clock_.time("inject", [&] { lighting_.inject(volume, rays); });
        clock_.time("merge", [&] { volume.merge(double(rays.size()), float(parts_.halves) / float(rays.size()), parallelFor_); });
    }

private:
    StillLightingSettings stillSettings() const {
        StillLightingSettings still;
        still.layout = settings_.layout, still.parts = parts_;
        still.seed = settings_.seed, still.originOffset = scene_.surfaceOffset();
        return still;
    }
    void cut(std::span<ClvRay> rays) {
        if (!settings_.keepHits) return target_.trace(rays);
        const std::size_t offset = rays.data() - lighting_.currentRays().data();
        target_.trace(rays, std::span(hits_).subspan(offset, rays.size()));
    }

    const LightingSettings settings_;
    const VolumeParts parts_;
    const EmbreeScene& scene_;
    const EmbreeScene& target_;
    const ParallelFor& parallelFor_;
    StageClock& clock_;
    LightMaps maps_;
    TexelSampler sampler_;
    const RayGuide* guide_ = nullptr;
    StillLighting lighting_;
    std::vector<ClvHit> hits_;
};

}  // namespace

CpuBackend::CpuBackend(const EmbreeScene& scene, const EmbreeScene& target, std::uint32_t seed, const ParallelFor& parallelFor, StageClock& clock)
    : scene_(scene), target_(target), seed_(seed), parallelFor_(parallelFor), clock_(clock) {}

std::unique_ptr<Lighting> CpuBackend::makeLighting(const LightingSettings& settings) {
    return std::make_unique<CpuLighting>(settings, scene_, target_, seed_, parallelFor_, clock_);
}

}  // namespace clv
