// The rays of one frame on the CPU: drawn, culled, and cut by the host's tracer.
#ifndef CLV_CPU_FRAME_RAYS_H
#define CLV_CPU_FRAME_RAYS_H
#include <functional>

#include "rays.h"
#include "volume.h"

namespace clv {

// The trace stage, supplied by the host: cuts each ray at its first hit. Called from several threads at once.
using Tracer = std::function<void(std::span<ClvRay>)>;

class FrameRays {
public:
    // All halves share one sequence, from `seed`, so that together they are spread as evenly as a frame without halves.
    // originOffset: m; rays start this far above their surface.
    FrameRays(const VolumeParts& parts, uint seed, float originOffset) : parts_(parts), seed_(clvHashCombine(seed, 0u)), originOffset_(originOffset) {}

    // Takes and touches the memory of `count` rays, so that no frame of as many has to.
    void reserve(std::size_t count) {
        if (rays_.size() < count) rays_.resize(count + std::size_t(parts_.halves) * parts_.chunks);
    }

    // `count` rays, rounded up so that each half and chunk has as many; their sequence goes on where the last frame's ended.
    // Allocates only when it exceeds every count so far.
    void draw(const TexelSampler& sampler, std::size_t count, const ParallelFor& parallelFor) {
        const std::size_t parts = std::size_t(parts_.halves) * parts_.chunks;
        perPart_ = (count + parts - 1) / parts;
        rays_.resize(perPart_ * parts);
        forPieces(parallelFor, [&](std::size_t first, std::size_t last) {
            makeRays(sampler, nextIndex_ + uint(first), seed_, originOffset_, std::span(rays_).subspan(first, last - first));
        });
        nextIndex_ += uint(rays_.size());
    }

    // Kills the rays that no volume can notice: those that would miss all of them even if nothing stood in their way.
    void cull(std::span<const ClvVolume> volumes, const ParallelFor& parallelFor) {
        forPieces(parallelFor, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                auto misses = [&](const ClvVolume& volume) { return missesVolume(rays_[i], volume); };
                if (std::all_of(volumes.begin(), volumes.end(), misses)) rays_[i] = clvDeadRay();
            }
        });
    }

    void trace(const Tracer& tracer, const ParallelFor& parallelFor) {
        forPieces(parallelFor, [&](std::size_t first, std::size_t last) { tracer(std::span(rays_).subspan(first, last - first)); });
    }

    std::span<const ClvRay> all() const { return rays_; }
    // The share of a chunk; the chunks of a half are neighbours.
    std::span<const ClvRay> part(std::size_t index) const { return std::span(rays_).subspan(index * perPart_, perPart_); }
    std::size_t perHalf() const { return perPart_ * parts_.chunks; }

private:
    static bool missesVolume(const ClvRay& ray, const ClvVolume& volume) {
        const vec3 hi = volume.origin + volume.cellSize * vec3(volume.resolution);
        const vec3 coordinates = max(max(abs(volume.origin), abs(hi)), abs(ray.origin));
        // Wider by the rounding of the coordinates, so that light which just touches the volume is kept.
        const float margin = 1e-6f * std::max(std::max(coordinates.x, coordinates.y), coordinates.z);
        return clvRayMissesRegion(ray.origin, ray.direction, ray.maxDistance, volume.origin, hi, margin);
    }

    template <class Body>
    void forPieces(const ParallelFor& parallelFor, Body&& body) {
        const std::size_t kPiece = 2048;
        auto one = [&](std::size_t piece) { body(piece * kPiece, std::min(rays_.size(), (piece + 1) * kPiece)); };
        parallelFor((rays_.size() + kPiece - 1) / kPiece, std::ref(one));
    }

    VolumeParts parts_;
    uint seed_;
    float originOffset_;
    std::vector<ClvRay> rays_;
    std::size_t perPart_ = 0;
    uint nextIndex_ = 0;
};

}  // namespace clv
#endif
