#include "bindings/cli/vulkan_lighting.h"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <utility>

#include "bindings/cli/light_walk.h"
#include "bindings/cli/scene_facts.h"
#include "bindings/embree/light_maps.h"
#include "bindings/vulkan/vulkan_level.h"
#include "clv/plan/largest_flux.h"
#include "clv/plan/triangle_corners.h"

namespace clv {
namespace {

constexpr std::uint64_t kMostRays = 128 << 10;  // of a submission: the lists of rays in bricks grow with them

// Runs a step; its run time goes to the stages in the shares that the device's clock says.
template <class StageOfPass>
void runTimed(VulkanFrame& frame, std::string_view step, StageClock& clock, StageOfPass&& stageOfPass) {
    const double seconds = StageClock::secondsOf([&] { frame.run(step); });
    const auto times = frame.times(step);
    double sum = 0.0;
    for (const auto& [pass, ms] : times) sum += ms;
    if (!(sum > 0.0)) return clock.add(stageOfPass(""), seconds);
    for (const auto& [pass, ms] : times) clock.add(stageOfPass(pass), seconds * ms / sum);
}

// Rays of a shot: `perHalf` from first on and as many for each further half.
struct Shot {
    uint first = 0;
    std::uint64_t perHalf = 0;
};

class VulkanLevel : public LightLevel {
public:
    // rays: the frame that shares its rays; null where the host gives them.
    VulkanLevel(Level level, LightFrameSettings settings, VulkanDevice& device, const VulkanFrame* rays)
        : level_(std::move(level)), bricks_(brickSlots(level_)), settings_(withLevel(std::move(settings), describeLevel(level_, bricks_), rays != nullptr)),
          frame_(lightFrame(settings_)), run_(device, frame_, ShaderLanguage::glsl, rays) {
        uploadLevel(run_, settings_, 0, level_, bricks_);
    }

    const Level& level() const override { return level_; }
    double rays() const override { return rays_; }
    std::size_t bytes() const override { return level_.bytes() + frame_.bytes(); }

    std::vector<std::span<const float>> histories() override {
        const std::size_t floats = level_.slots.size() * frameStride(settings_);
        if (!downloaded_) {
            history_.assign(settings_.halves * floats, 0.0f);
            if (rays_ > 0.0) run_.download("history 0", std::span(history_));
            downloaded_ = true;
        }
        std::vector<std::span<const float>> halves;
        for (std::size_t half = 0; half < settings_.halves; ++half) halves.push_back(std::span<const float>(history_).subspan(half * floats, floats));
        return halves;
    }

    void upload(std::span<const ClvRay> rays) { run_.upload("rays", rays); }
    // Adds the rays that lie in the buffer. largestFlux: W, of any channel of any ray.
    void add(const ClvFrame& constants, float largestFlux, StageClock& clock) {
        rays_ += constants.rayCount;
        LightFrameSettings settings = settings_;
        settings.rays = constants.rayCount;
        run_.upload("frame", constants);
        run_.upload("level 0", levelConstants(level_, bricks_, settings, float(constants.rayCount / rays_), largestFlux));
        runTimed(run_, "light", clock, [](const std::string& pass) { return pass.starts_with("merge") ? "merge" : "inject"; });
        downloaded_ = false;
    }

private:
    static LightFrameSettings withLevel(LightFrameSettings settings, const LightFrameLevel& level, bool sharedRays) {
        settings.lights = settings.emitters = settings.guideRows = 0;
        settings.keepHits = false, settings.sharedRays = sharedRays;
        settings.levels = {level};
        return settings;
    }

    Level level_;
    BrickSlots bricks_;
    LightFrameSettings settings_;
    Frame frame_;
    VulkanFrame run_;
    double rays_ = 0.0;
    std::vector<float> history_;  // of all halves
    bool downloaded_ = false;
};

class VulkanLighting : public Lighting {
public:
    VulkanLighting(const LightingSettings& settings, const VulkanBackend::Parts& parts)
        : settings_(settings), parts_(parts), lights_(lightsThatSend(parts.scene.scene())), maps_(parts.scene, parts.seed, parts.parallelFor) {
        frame_.halves = std::uint32_t(settings.halves), frame_.storage = settings.layout.storage;
        frame_.channels = std::uint32_t(settings.layout.channels), frame_.turned = settings.layout.frame != mat3(1.0f);
        frame_.inject = parts.inject, frame_.keepHits = settings.keepHits;
        frame_.triangles = parts.surfaces.surfaces.size() / kClvSurfaceRows, frame_.bvhNodes = parts.bvh.children.size();
        frame_.textureTexels = parts.surfaces.textureTexels.size();
        frame_.trace = defaultTrace(parts.device.info());
        if (frame_.trace != TraceWay::walk) frame_.accelerationBytes = parts.device.accelerationBytes(frame_.triangles);
        frame_.rsmSide = settings.emitters > 0 ? std::uint64_t(kEmitterWidth) : std::uint64_t(maps_.side());
        const std::uint64_t mapTexels = lights_.size() * frame_.rsmSide * frame_.rsmSide;
        frame_.lights = settings.emitters == 0 && parts.ownMaps ? lights_.size() : 0;
        frame_.emitters = frame_.lights > 0 ? 0 : settings.emitters > 0 ? settings.emitters : mapTexels;

        LightFrameSettings largest = frame_;
        largest.levels.resize(1);
        largest.levels[0].volume = settings.finest;
        const std::uint64_t wanted = std::min(kMostRays, raysPerHalf(std::min(settings.rays, kMostRays)) * frame_.halves);
        frame_.rays = std::max<std::uint64_t>(std::min(wanted, largestFrameRays(largest, parts.device.info().limits)) / frame_.halves, 1) * frame_.halves;

        const Bounds& bounds = parts.scene.scene().bounds;
        constants_.boundsLo = bounds.lo, constants_.boundsHi = bounds.hi;
        constants_.seed = clvHashCombine(settings.seed, 0u);
        constants_.halves = frame_.halves;
        constants_.rsmSeed = parts.seed, constants_.rsmSide = uint(frame_.rsmSide);
        constants_.texelRows = uint((frame_.lights > 0 ? mapTexels : frame_.emitters) / frame_.rsmSide);
        constants_.triangleCount = uint(frame_.triangles);
        constants_.originOffset = parts.scene.surfaceOffset();
        keepDirectionsAlong(settings.layout.frame, constants_);
        largestFlux_ = largestRayFlux(lights_, bounds.lo, bounds.hi);
        makeFrame();
    }

    void renderMaps(std::uint32_t pass) override {
        if (frame_.lights == 0) {
            std::span<const ClvRsmTexel> texels;
            parts_.clock.time("rsm", [&] { texels = maps_.render(pass); });
            return emit(texels);
        }
        constants_.rsmPass = pass;
        parts_.clock.time("rsm", [&] {
            run_->upload("frame", constants_);
            run_->run("rsm");
        });
    }
    void emit(std::span<const ClvRsmTexel> emitters) override {
        if (emitters.size() > frame_.emitters) throw std::logic_error("more emitters than the lighting has room for");
        constants_.texelRows = uint(emitters.size() / frame_.rsmSide);
        parts_.clock.time("rsm", [&] {
            run_->upload("frame", constants_);
            run_->upload("texels", emitters);
            run_->run("rsm");
        });
    }

    void draw(std::uint32_t seed, std::span<ClvRay> rays, std::span<ClvHit> hits) override {
        ClvFrame constants = constants_;
        constants.halves = 1, constants.seed = seed;
        for (std::size_t done = 0; done < rays.size(); done += frame_.rays) {
            const auto piece = rays.subspan(done, std::min<std::size_t>(frame_.rays, rays.size() - done));
            constants.firstIndex = uint(done), constants.rayCount = uint(piece.size());
            run_->upload("frame", constants);
            run_->run("light");
            run_->download("rays", piece);
            if (!hits.empty()) run_->download("hits", hits.subspan(done, piece.size()));
        }
    }
    void guideBy(const RayGuide& guide) override {
        frame_.guideCells = guide.cells().size(), frame_.guideRows = guide.weights().size() / kClvGuideRow;
        gain_ = guide.largestGain();
        makeFrame();
        run_->upload("guide", guide.grid());
        run_->upload("guide cells", guide.cells());
        run_->upload("guide weights", guide.weights());
    }

    std::unique_ptr<LightLevel> makeLevel(Level level) override {
        return std::make_unique<VulkanLevel>(std::move(level), frame_, parts_.device, settings_.emitters > 0 ? nullptr : &*run_);
    }

    std::size_t shoot(std::size_t count, std::span<LightLevel* const> levels) override {
        shot_ = {nextIndex_, raysPerHalf(count)};
        lit_ = {};
        forPieces([&](const ClvFrame& constants) {
            for (LightLevel* level : levels) addTo(*level, constants);
            if (settings_.keepHits) noteLit(constants.rayCount);
        });
        const std::uint64_t rays = shot_.perHalf * frame_.halves;
        nextIndex_ += uint(rays);
        return rays;
    }
    // Rays follow from their number: they are drawn and traced again.
    void shootAgain(LightLevel& level) override {
        forPieces([&](const ClvFrame& constants) { addTo(level, constants); });
    }
    LitPlaces takeLit(int half) override { return std::exchange(lit_[std::size_t(half)], {}); }

    void add(std::span<const ClvRay> rays, LightLevel& level) override {
        VulkanLevel& target = static_cast<VulkanLevel&>(level);
        ClvFrame constants = constants_;
        const std::size_t perHalf = rays.size() / frame_.halves, most = frame_.rays / frame_.halves;
        for (std::size_t done = 0; done < perHalf; done += most) {
            const std::size_t count = std::min(most, perHalf - done);
            rays_.clear();
            for (std::size_t half = 0; half < frame_.halves; ++half) {
                const auto piece = rays.subspan(half * perHalf + done, count);
                rays_.insert(rays_.end(), piece.begin(), piece.end());
            }
            constants.rayCount = uint(rays_.size());
            target.upload(rays_);
            target.add(constants, largestRayFlux(rays_), parts_.clock);
        }
    }

private:
    // Of a shot of `count` rays, rounded up as on the CPU.
    std::uint64_t raysPerHalf(std::uint64_t count) const {
        const VolumeParts parts = volumeParts(settings_.halves, settings_.rays);
        const auto chunks = std::uint64_t(parts.chunks), all = std::uint64_t(parts.halves) * chunks;
        return (std::max<std::uint64_t>(count, 1) + all - 1) / all * chunks;
    }

    void makeFrame() {
        run_.reset();  // its memory is free before the next one takes it
        run_.emplace(parts_.device, lightFrame(frame_));
        if (frame_.lights > 0) run_->upload("lights", std::span<const ClvLight>(lights_));
        run_->upload("triangles", std::span(parts_.bvh.triangles));
        if (frame_.trace == TraceWay::walk) {
            run_->upload("bvh boxes", std::span(parts_.bvh.boxes));
            run_->upload("bvh children", std::span(parts_.bvh.children));
        } else {
            run_->upload("corners", std::span<const vec3>(triangleCorners(parts_.bvh.triangles, frame_.triangles)));
            run_->run("scene");
        }
        if (frame_.lights == 0 && !frame_.keepHits) return;
        run_->upload("surfaces", std::span(parts_.surfaces.surfaces));
        if (frame_.textureTexels == 0) return;
        run_->upload("texture rows", std::span(parts_.surfaces.textureRows));
        run_->upload("texture texels", std::span(parts_.surfaces.textureTexels));
    }

    // Draws and traces the rays of the last shot, as many at a time as the frame holds, each time the same share of all halves.
    template <class Body>
    void forPieces(Body&& body) {
        ClvFrame constants = constants_;
        constants.halfStep = uint(shot_.perHalf);
        const std::uint64_t most = frame_.rays / frame_.halves;
        for (std::uint64_t done = 0; done < shot_.perHalf; done += most) {
            constants.firstIndex = shot_.first + uint(done);
            constants.rayCount = uint(std::min(most, shot_.perHalf - done) * frame_.halves);
            run_->upload("frame", constants);
            runTimed(*run_, "light", parts_.clock, [](const std::string& pass) { return pass == "rays" ? "rays" : "trace"; });
            body(constants);
        }
    }

    void addTo(LightLevel& level, const ClvFrame& constants) {
        const float flux = guidedRayFlux(largestFlux_, gain_, double(constants.rayCount / constants.halves));
        static_cast<VulkanLevel&>(level).add(constants, flux, parts_.clock);
    }

    void noteLit(std::size_t count) {
        rays_.resize(count);
        hits_.resize(count);
        run_->download("rays", std::span(rays_));
        run_->download("hits", std::span(hits_));
        const std::size_t perHalf = count / frame_.halves;
        for (std::size_t half = 0; half < frame_.halves; ++half) {
            addLit(std::span(rays_).subspan(half * perHalf, perHalf), std::span(hits_).subspan(half * perHalf, perHalf), 1.0f / float(shot_.perHalf), lit_[half]);
        }
    }

    const LightingSettings settings_;
    const VulkanBackend::Parts& parts_;
    const std::vector<ClvLight> lights_;
    LightMaps maps_;
    LightFrameSettings frame_;
    ClvFrame constants_{};
    float largestFlux_ = 0.0f;  // W, of any channel of any unguided ray
    float gain_ = 1.0f;         // by which a guide raises that
    std::optional<VulkanFrame> run_;
    uint nextIndex_ = 0;
    Shot shot_;
    std::array<LitPlaces, 2> lit_;  // by the halves of the last shot
    std::vector<ClvRay> rays_;
    std::vector<ClvHit> hits_;
};

}  // namespace

VulkanBackend::VulkanBackend(const BackendOptions& options, const EmbreeScene& scene, const EmbreeScene& target, std::uint32_t seed,
                             const ParallelFor& parallelFor, StageClock& clock)
    : device_({.device = options.device, .rayQueries = true, .rayPipelines = true, .loader = options.loader}), bvh_(buildBvh(target.scene())), surfaces_(surfaceRowsOf(target.scene())),
      parts_{device_, options.repeatable ? InjectWay::fixedPoint : defaultInject(device_.info().features), scene, bvh_, surfaces_, &scene == &target, seed, parallelFor, clock} {}

std::unique_ptr<Lighting> VulkanBackend::makeLighting(const LightingSettings& settings) { return std::make_unique<VulkanLighting>(settings, parts_); }

}  // namespace clv
