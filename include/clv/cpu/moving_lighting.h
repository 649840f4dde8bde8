// Light around a moving camera on the CPU: nested volumes that follow it, frame by frame.
//
// A frame is moveTo -> rays -> trace -> inject -> merge, in this order; the caller may time each. Between frames irradiance() may
// be called from several threads. A frame allocates nothing once the volumes and the rays have been as large as they get.
#ifndef CLV_CPU_MOVING_LIGHTING_H
#define CLV_CPU_MOVING_LIGHTING_H
#include "frame_rays.h"
#include "moving_volume.h"

namespace clv {

struct MovingLightingSettings {
    CascadeDesc cascades{};
    float blendCells = 2.0f;        // >= 0: width of the zone where neighbouring cascades mix, cells of the finer one
    glm::dvec3 anchor{0.0};         // m, world space: the probe, the tracer, texels and receivers are relative to it
    DepositLayout layout{};
    int chunks = 1;                 // >= 1: pieces of a frame's rays that are injected at the same time; results depend on it
    uint rule = kClvInjectTrackLength;
    uint seed = 1;
    float originOffset = 1e-4f;     // m; rays start this far above their surface
    int linesPerCell = 4;           // see MovingLevelSettings
    float slotsPerCell = 1.5f;
    bool movingLights = false;      // see MovingVolumeSettings
    float guessFrames = 8.0f;
    float slidOutFrames = 1.0f;
    float newCellDynamicity = 0.5f;
    ClvMergeSettings merge{.timestep = 1.0f / 60.0f, .stillTime = kClvFar, .movingTime = 0.05f, .dynamicityTime = 0.5f};
    LookupOptions lookup{};
};

// More threads than that, and lines finer than that, are mistakes.
inline constexpr int kMostChunks = 4096, kMostLinesPerCell = 64;
// A float still tells a quarter of a cell apart this many cells from the anchor.
inline constexpr double kMostCellsFromAnchor = 4194304.0;

// What is wrong with the settings, in words; empty if nothing is.
inline std::string validate(const MovingLightingSettings& settings) {
    for (const std::string& problem : {validate(settings.cascades), validate(settings.layout), validate(settings.lookup)}) {
        if (!problem.empty()) return problem;
    }
    if (!liesIn(settings.blendCells, 0.0, kClvFar)) return "moving light: blendCells must be finite, and not negative";
    if (!isFinite(settings.anchor.x) || !isFinite(settings.anchor.y) || !isFinite(settings.anchor.z)) return "moving light: anchor must be finite";
    if (settings.chunks < 1 || settings.chunks > kMostChunks) return "moving light: chunks must lie in [1, " + std::to_string(kMostChunks) + "]";
    if (settings.linesPerCell < 1 || settings.linesPerCell > kMostLinesPerCell) return "moving light: linesPerCell must lie in [1, " + std::to_string(kMostLinesPerCell) + "]";
    if (settings.rule != kClvInjectTrackLength && settings.rule != kClvInjectThesis) return "moving light: rule must be one of kClvInject...";
    if (!liesIn(settings.slotsPerCell, 0.0, kClvMostSlots) || settings.slotsPerCell == 0.0f) {
        return "moving light: slotsPerCell must lie in (0, " + std::to_string(kClvMostSlots) + "]";
    }
    if (!liesIn(settings.originOffset, 0.0, kClvFar)) return "moving light: originOffset must be finite, and not negative";
    if (!liesIn(settings.guessFrames, 0.0, kClvFar) || !liesIn(settings.slidOutFrames, 0.0, kClvFar)) {
        return "moving light: guessFrames and slidOutFrames must be finite, and not negative";
    }
    if (!liesIn(settings.newCellDynamicity, 0.0, 1.0)) return "moving light: newCellDynamicity must lie in [0, 1]";
    const ClvMergeSettings& merge = settings.merge;
    constexpr double kShortest = std::numeric_limits<float>::min();
    if (!liesIn(merge.timestep, kShortest) || !liesIn(merge.movingTime, kShortest) || !liesIn(merge.stillTime, merge.movingTime) || !liesIn(merge.dynamicityTime, kShortest)) {
        return "moving light: the times of the merge must be finite and above 0, and movingTime at most stillTime";
    }
    return {};
}

// The same for a camera, and for the two together.
inline std::string validate(const MovingLightingSettings& settings, const CameraView& view) {
    if (std::string problem = validate(settings); !problem.empty()) return problem;
    if (std::string problem = validate(settings.cascades, view); !problem.empty()) return problem;
    if (!liesIn(glm::length(view.position - settings.anchor), 0.0, kMostCellsFromAnchor * settings.cascades.finestCellSize)) {
        return "camera: position is more than 2^22 of the finest cells away from the anchor";
    }
    return {};
}

class MovingLighting {
public:
    // The settings must be valid. Covers nothing until moveTo() is called for the first time.
    MovingLighting(const MovingLightingSettings& settings, SceneProbe probe, Tracer tracer, ParallelFor parallelFor)
        : settings_(settings), probe_(std::move(probe)), tracer_(std::move(tracer)), parallelFor_(std::move(parallelFor)),
          rays_({.halves = 1, .chunks = settings.chunks}, settings.seed, settings.originOffset) {
        volumes_.reserve(std::size_t(settings.cascades.count));
        for (int level = 0; level < settings.cascades.count; ++level) volumes_.emplace_back(volumeSettings(settings));
    }

    // Bytes before they are taken: tables, slots, deposits and history of all cascades. Rays come on top, sizeof(ClvRay) each.
    static std::size_t bytes(const MovingLightingSettings& settings) {
        return std::size_t(settings.cascades.count) * MovingVolume::bytes(volumeSettings(settings));
    }
    std::size_t bytes() const {
        std::size_t sum = 0;
        for (const MovingVolume& volume : volumes_) sum += volume.bytes();
        return sum;
    }

    // The view must be valid with the settings. Coarse cascades go first, so that finer ones can ask them for what they do not know yet.
    void moveTo(const CameraView& view) {
        cascades_ = placeCascades(settings_.cascades, view, settings_.anchor, settings_.layout.storage, settings_.blendCells);
        const MovingVolume* coarser = nullptr;
        for (int level = settings_.cascades.count - 1; level >= 0; --level) {
            volumes_[level].moveTo(placeCascade(settings_.cascades, view, level), coarser, probe_, parallelFor_);
            coarser = &volumes_[level];
        }
    }

    // About `count` rays, fewer those that cannot reach any cascade. A frame without rays leaves the history as it is.
    void rays(const TexelSampler& sampler, std::size_t count) {
        rays_.draw(sampler, count, parallelFor_);
        rays_.cull(std::span(cascades_.volumes, cascades_.count), parallelFor_);
    }
    void trace() { rays_.trace(tracer_, parallelFor_); }
    // Where memory runs out on the way, nothing is injected.
    void inject() {
        const std::size_t chunks = std::size_t(settings_.chunks);
        auto injectOne = [&](std::size_t job) {
            MovingVolume& volume = volumes_[job / chunks];
            const std::size_t chunk = job % chunks;
            clv::inject(volume.level(), settings_.layout, settings_.rule, rays_.part(chunk), volume.partial(int(chunk)));
        };
        try {
            parallelFor_(volumes_.size() * chunks, std::ref(injectOne));
        } catch (...) {
            for (MovingVolume& volume : volumes_) volume.dropFrame();
            throw;
        }
    }
    // timestep: s, > 0, since the last frame.
    void merge(float timestep) {
        if (rays_.perHalf() == 0) return;
        ClvMergeSettings merge = settings_.merge;
        merge.timestep = timestep;
        for (MovingVolume& volume : volumes_) volume.merge(1.0f / float(rays_.perHalf()), merge, parallelFor_);
    }

    // Irradiance, W/m^2, from the finest cascade that holds the receiver, mixed with the next one near its edge. Beyond the last
    // cascade the light is that of its edge; before the first move there is none.
    vec3 irradiance(const ClvReceiver& receiver) const {
        if (cascades_.count == 0u) return vec3(0.0f);
        const uint cascade = clvCascadeFromPosition(cascades_, receiver.position);
        const float weight = clvCascadeWeight(cascades_, cascade, receiver.position);
        if (weight == 1.0f) return irradianceOf(cascade, receiver);
        return mix(irradianceOf(cascade + 1, receiver), irradianceOf(cascade, receiver), weight);
    }

    // Forgets all light; the cascades stay where they are.
    void reset() {
        for (MovingVolume& volume : volumes_) volume.reset();
    }

    const ClvCascades& cascades() const { return cascades_; }
    const std::vector<MovingVolume>& volumes() const { return volumes_; }
    // This frame's rays, cut once trace() has run.
    std::span<const ClvRay> currentRays() const { return rays_.all(); }

private:
    static MovingVolumeSettings volumeSettings(const MovingLightingSettings& s) {
        return {.level = {.resolution = s.cascades.resolution, .storage = s.layout.storage, .anchor = s.anchor,
                          .linesPerCell = s.linesPerCell, .slotsPerCell = s.slotsPerCell},
                .layout = s.layout,
                .chunks = s.chunks,
                .movingLights = s.movingLights,
                .guessFrames = s.guessFrames,
                .slidOutFrames = s.slidOutFrames,
                .newCellDynamicity = s.newCellDynamicity};
    }

    vec3 irradianceOf(uint cascade, ClvReceiver receiver) const {
        receiver.position = clvClampToVolume(cascades_.volumes[cascade], receiver.position);
        return volumes_[cascade].irradiance(receiver, settings_.lookup);
    }

    MovingLightingSettings settings_;
    SceneProbe probe_;
    Tracer tracer_;
    ParallelFor parallelFor_;
    FrameRays rays_;
    ClvCascades cascades_{};
    std::vector<MovingVolume> volumes_;  // finest first
};

}  // namespace clv
#endif
