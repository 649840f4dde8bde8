// A frame of still light on the CPU, stage by stage: rays -> trace -> inject -> merge, into one or more levels.
//
// The caller runs the stages in this order, as often as it likes, and may time each. Levels see the same rays.
#ifndef CLV_CPU_STILL_LIGHTING_H
#define CLV_CPU_STILL_LIGHTING_H
#include <deque>

#include "rays.h"
#include "volume.h"

namespace clv {

// The trace stage, supplied by the host: cuts each ray at its first hit. Called from several threads at once.
using Tracer = std::function<void(std::span<ClvRay>)>;

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
        : settings_(settings), tracer_(std::move(tracer)), parallelFor_(std::move(parallelFor)) {}

    // A further level. It knows nothing of the rays that came before it.
    Volume& addLevel(Level level) {
        return volumes_.emplace_back(std::move(level), settings_.layout, settings_.parts, false);
    }
    void removeFirstLevel() { volumes_.pop_front(); }
    std::deque<Volume>& volumes() { return volumes_; }
    const std::deque<Volume>& volumes() const { return volumes_; }

    // `count` rays, rounded up so that each half and chunk has as many. Allocates only when it exceeds every count so far.
    void rays(const TexelSampler& sampler, std::size_t count) {
        const std::size_t parts = std::size_t(settings_.parts.halves) * settings_.parts.chunks;
        perPart_ = (count + parts - 1) / parts;
        rays_.resize(perPart_ * parts);
        const std::size_t perHalf = perPart_ * settings_.parts.chunks;
        forPieces([&](std::size_t first, std::size_t last) {
            // A piece may reach from one half into the next, which has a sequence of its own.
            while (first < last) {
                const std::size_t half = first / perHalf, end = std::min(last, (half + 1) * perHalf);
                makeRays(sampler, nextIndex_ + uint(first - half * perHalf), clvHashCombine(settings_.seed, uint(half)), settings_.originOffset,
                         std::span(rays_).subspan(first, end - first));
                first = end;
            }
        });
        nextIndex_ += uint(perHalf);
    }

    void trace() {
        forPieces([&](std::size_t first, std::size_t last) { tracer_(std::span(rays_).subspan(first, last - first)); });
    }

    void inject() {
        for (Volume& volume : volumes_) inject(volume);
    }
    // Into one level only: a level that joins late in a frame still gets all of the frame's rays.
    void inject(Volume& volume) {
        parallelFor_(std::size_t(settings_.parts.halves) * settings_.parts.chunks, [&](std::size_t part) {
            clv::inject(volume.level(), settings_.layout, settings_.rule, std::span(rays_).subspan(part * perPart_, perPart_),
                        volume.partial(int(part) / settings_.parts.chunks, int(part) % settings_.parts.chunks));
        });
    }

    void merge() {
        for (Volume& volume : volumes_) merge(volume);
    }
    void merge(Volume& volume) {
        const double perHalf = double(perPart_) * settings_.parts.chunks;
        volume.merge(perHalf * settings_.parts.halves, float(1.0 / perHalf), parallelFor_);
    }

    // This frame's rays, cut once trace() has run.
    std::span<const ClvRay> currentRays() const { return rays_; }

private:
    template <class Body>
    void forPieces(Body&& body) {
        const std::size_t kPiece = 2048;
        parallelFor_((rays_.size() + kPiece - 1) / kPiece, [&](std::size_t piece) {
            body(piece * kPiece, std::min(rays_.size(), (piece + 1) * kPiece));
        });
    }

    StillLightingSettings settings_;
    Tracer tracer_;
    ParallelFor parallelFor_;
    std::deque<Volume> volumes_;
    std::vector<ClvRay> rays_;
    std::size_t perPart_ = 0;
    uint nextIndex_ = 0;
};

}  // namespace clv
#endif
