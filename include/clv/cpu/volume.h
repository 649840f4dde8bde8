// A level with its light, where nothing moves: this frame's deposits, and the history that they are merged into.
#ifndef CLV_CPU_VOLUME_H
#define CLV_CPU_VOLUME_H
#include <utility>

#include "parallel.h"
#include "partial_volume.h"

namespace clv {

// How a frame's deposits are kept. The rays of a frame are cut into `halves` independent estimates, so that they can judge each
// other, and each half into `chunks` partial volumes, so that they can be filled at the same time. Results depend on these
// numbers, never on the number of threads.
struct VolumeParts {
    int halves = 2;  // 1 or 2
    int chunks = 1;  // >= 1, a half
};

class Volume {
public:
    Volume(Level level, const DepositLayout& layout, const VolumeParts& parts)
        : level_(std::move(level)), layout_(layout), parts_(parts), partials_(std::size_t(parts.halves) * parts.chunks), history_(parts.halves) {
        for (PartialVolume& partial : partials_) partial.resize(level_.slots.size(), layout_, false);
        for (AlignedFloats& half : history_) half.resize(level_.slots.size() * layout_.stride());
    }

    // Bytes that a Volume of this many slots holds, before it is made; the level's own tables come on top.
    static std::size_t bytes(std::size_t slots, const DepositLayout& layout, const VolumeParts& parts) {
        return layout.bytes(slots) * std::size_t(parts.halves) * (parts.chunks + 1);
    }
    std::size_t bytes() const { return level_.bytes() + bytes(level_.slots.size(), layout_, parts_); }

    const Level& level() const { return level_; }
    const DepositLayout& layout() const { return layout_; }
    const VolumeParts& parts() const { return parts_; }
    // Rays merged so far.
    double rays() const { return rays_; }

    // One partial volume, cleared by the last merge. Different ones may be filled from different threads.
    DepositTarget partial(int half, int chunk) { return partials_[std::size_t(half) * parts_.chunks + chunk].target(); }

    // Mean deposits of a half, one record of layout().stride() floats a slot: W m for one frame's whole flux.
    std::span<const float> history(int half) const { return history_[half]; }

    // The history becomes the mean over all rays so far, those of this frame weighing rays / (rays so far). `scale` turns this
    // frame's raw sums into an estimate. Clears the partial volumes for the next frame.
    void merge(double rays, float scale, const ParallelFor& parallelFor) {
        rays_ += rays;
        const float weight = rays_ > 0.0 ? float(rays / rays_) : 0.0f;
        const std::size_t stride = layout_.stride(), slots = level_.slots.size(), kPiece = 2048;
        const std::size_t pieces = (slots + kPiece - 1) / kPiece;
        auto mergePiece = [&](std::size_t job) {
            const std::size_t half = job / pieces, first = job % pieces * kPiece;
            const auto chunks = std::span(partials_).subspan(half * parts_.chunks, std::size_t(parts_.chunks));
            for (std::size_t slot = first; slot < std::min(slots, first + kPiece); ++slot) {
                mergeDeposits(chunks, slot, stride, scale, weight, history_[half].data() + slot * stride);
            }
        };
        parallelFor(pieces * parts_.halves, std::ref(mergePiece));
    }

    // Forgets what was injected since the last merge.
    void dropFrame() {
        for (PartialVolume& partial : partials_) partial.clear();
    }
    // Forgets all light.
    void reset() {
        rays_ = 0.0;
        dropFrame();
        for (AlignedFloats& half : history_) std::fill(half.begin(), half.end(), 0.0f);
    }

private:
    Level level_;
    DepositLayout layout_;
    VolumeParts parts_;
    std::vector<PartialVolume> partials_;  // those of a half are neighbours
    std::vector<AlignedFloats> history_;   // a half each
    double rays_ = 0.0;
};

// The mean of two halves, so that receivers read one record a slot.
inline void averageHalves(std::span<const float> a, std::span<const float> b, const ParallelFor& parallelFor, AlignedFloats& mean) {
    constexpr std::size_t kPiece = 64 << 10;  // floats
    mean.resize(a.size());
    parallelFor((a.size() + kPiece - 1) / kPiece, [&](std::size_t piece) {
        for (std::size_t k = piece * kPiece; k < std::min(a.size(), (piece + 1) * kPiece); ++k) mean[k] = 0.5f * (a[k] + b[k]);
    });
}

}  // namespace clv
#endif
