// A frame of still light on the CPU, stage by stage: rays -> trace -> inject -> merge, into one or more levels.
//
// The caller runs the stages in this order, as often as it likes, and may time each. Levels see the same rays.
#ifndef CLV_CPU_STILL_LIGHTING_H
#define CLV_CPU_STILL_LIGHTING_H
#include <deque>

#include "frame_rays.h"

namespace clv {

struct StillLightingSettings {
    DepositLayout layout;
    VolumeParts parts;
    uint rule = kClvInjectTrackLength;
    uint seed = 1;
    float originOffset = 1e-4f;  // m; rays start this far above their surface
};

class StillLighting {
public:
    StillLighting(const StillLightingSettings& settings, Tracer tracer, ParallelFor parallelFor)
        : settings_(settings), tracer_(std::move(tracer)), parallelFor_(std::move(parallelFor)),
          rays_(settings.parts, settings.seed, settings.originOffset) {}

    // A further level. It knows nothing of the rays that came before it.
    Volume& addLevel(Level level) { return volumes_.emplace_back(std::move(level), settings_.layout, settings_.parts); }
    std::deque<Volume>& volumes() { return volumes_; }
    const std::deque<Volume>& volumes() const { return volumes_; }

    // Takes the memory of `count` rays before the first frame.
    void reserveRays(std::size_t count) { rays_.reserve(count); }

    // `count` rays, rounded up so that each half and chunk has as many; without any, the frame leaves the history as it is. Allocates only when it exceeds every count so far.
    void rays(const TexelSampler& sampler, std::size_t count) { rays_.draw(sampler, count, parallelFor_); }

    void trace() { rays_.trace(tracer_, parallelFor_); }

    void inject() {
        for (Volume& volume : volumes_) inject(volume);
    }
    // Into one level only: a level that joins late in a frame still gets all of the frame's rays. Where memory runs out on the way, it gets none.
    void inject(Volume& volume) { inject(volume, rays_.all()); }
    // The same of rays of the caller's own, which are cut: as many for each half.
    void inject(Volume& volume, std::span<const ClvRay> rays) {
        const std::size_t chunks = std::size_t(settings_.parts.chunks), parts = chunks * std::size_t(settings_.parts.halves);
        auto injectPart = [&](std::size_t part) {
            const std::size_t first = rays.size() * part / parts, last = rays.size() * (part + 1) / parts;
            clv::inject(volume.level(), settings_.layout, settings_.rule, rays.subspan(first, last - first), volume.partial(int(part / chunks), int(part % chunks)));
        };
        try {
            parallelFor_(parts, std::ref(injectPart));
        } catch (...) {
            volume.dropFrame();
            throw;
        }
    }

    void merge() {
        for (Volume& volume : volumes_) merge(volume);
    }
    void merge(Volume& volume) {
        const double perHalf = double(rays_.perHalf());
        if (perHalf == 0.0) return;
        volume.merge(perHalf * settings_.parts.halves, float(1.0 / perHalf), parallelFor_);
    }

    // This frame's rays, cut once trace() has run.
    std::span<const ClvRay> currentRays() const { return rays_.all(); }

private:
    StillLightingSettings settings_;
    Tracer tracer_;
    ParallelFor parallelFor_;
    std::deque<Volume> volumes_;
    FrameRays rays_;
};

}  // namespace clv
#endif
