// A level with its light: this frame's deposits, and the history that they are merged into.
#ifndef CLV_CPU_VOLUME_H
#define CLV_CPU_VOLUME_H
#include <cassert>
#include <utility>

#include "../stages/merge.h"
#include "aligned.h"
#include "inject.h"
#include "parallel.h"

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
    Volume(Level level, const DepositLayout& layout, const VolumeParts& parts, bool withDynamicity)
        : level_(std::move(level)), layout_(layout), parts_(parts) {
        const std::size_t floats = level_.slots.size() * layout_.stride();
        const std::size_t sides = withDynamicity ? level_.slots.size() * 6 : 0;
        partials_.resize(std::size_t(parts.halves) * parts.chunks);
        for (Record& partial : partials_) partial.deposits.resize(floats), partial.dynamicity.resize(sides);
        history_.resize(parts.halves);
        for (Record& half : history_) half.deposits.resize(floats), half.dynamicity.resize(sides);
    }

    // Bytes that a Volume of this many slots holds, before it is made; the level's own tables come on top.
    static std::size_t bytes(std::size_t slots, const DepositLayout& layout, const VolumeParts& parts, bool withDynamicity) {
        const std::size_t record = layout.bytes(1) + (withDynamicity ? 6 * sizeof(float) : 0);
        return slots * record * std::size_t(parts.halves) * (parts.chunks + 1);
    }
    std::size_t bytes() const {
        return level_.bytes() + bytes(level_.slots.size(), layout_, parts_, !history_[0].dynamicity.empty());
    }

    const Level& level() const { return level_; }
    const DepositLayout& layout() const { return layout_; }
    const VolumeParts& parts() const { return parts_; }
    // Rays merged so far.
    double rays() const { return rays_; }

    // One partial volume, cleared by the last merge. Different ones may be filled from different threads.
    DepositTarget partial(int half, int chunk) {
        Record& r = partials_[std::size_t(half) * parts_.chunks + chunk];
        return {r.deposits, r.dynamicity};
    }

    // Mean deposits of a half, one record of layout().stride() floats a slot: W m for one frame's whole flux.
    std::span<const float> history(int half) const { return history_[half].deposits; }

    // Still light: the history becomes the mean over all rays so far, those of this frame weighing rays / (rays so far). `scale`
    // turns this frame's raw sums into an estimate. Clears the partial volumes for the next frame.
    void merge(double rays, float scale, const ParallelFor& parallelFor) {
        rays_ += rays;
        const float weight = rays_ > 0.0 ? float(rays / rays_) : 0.0f;
        mergeRecords(scale, parallelFor, [weight](Record&, std::size_t, const float*) { return weight; });
    }

    // Moving light: each record has its own weight, from the largest dynamicity among its sides.
    void merge(double rays, float scale, const ClvMergeSettings& settings, const ParallelFor& parallelFor) {
        rays_ += rays;
        mergeRecords(scale, parallelFor, [&settings](Record& half, std::size_t slot, const float* current) {
            float largest = 0.0f;
            for (int side = 0; side < 6; ++side) {
                float& kept = half.dynamicity[slot * 6 + side];
                kept = clvMergeDynamicity(settings, kept, current ? current[side] : 0.0f);
                largest = std::max(largest, kept);
            }
            const float weight = clvMergeWeight(settings, largest, half.frames[slot] + 1.0f);
            half.frames[slot] = clvFramesFromWeight(weight);
            return weight;
        });
    }

    // Forgets all light.
    void reset() {
        rays_ = 0.0;
        for (Record& r : partials_) clear(r);
        for (Record& r : history_) clear(r);
    }

private:
    struct Record {
        AlignedFloats deposits;
        std::vector<float> dynamicity;  // 6 a slot, or empty
        std::vector<float> frames;
    };
    static void clear(Record& r) {
        std::fill(r.deposits.begin(), r.deposits.end(), 0.0f);
        std::fill(r.dynamicity.begin(), r.dynamicity.end(), 0.0f);
        std::fill(r.frames.begin(), r.frames.end(), 0.0f);
    }

    template <class WeightOf>
    void mergeRecords(float scale, const ParallelFor& parallelFor, WeightOf&& weightOf) {
        const std::size_t stride = layout_.stride();
        const std::size_t slots = level_.slots.size();
        const std::size_t kPiece = 2048;
        const std::size_t pieces = (slots + kPiece - 1) / kPiece;
        parallelFor(pieces * parts_.halves, [&](std::size_t job) {
            Record& half = history_[job / pieces];
            Record* chunk = partials_.data() + job / pieces * parts_.chunks;
            const std::size_t first = job % pieces * kPiece, last = std::min(slots, first + kPiece);
            for (std::size_t slot = first; slot < last; ++slot) {
                float* __restrict sum = chunk[0].deposits.data() + slot * stride;
                for (int c = 1; c < parts_.chunks; ++c) {
                    float* __restrict other = chunk[c].deposits.data() + slot * stride;
                    for (std::size_t j = 0; j < stride; ++j) sum[j] += other[j], other[j] = 0.0f;
                }
                const float weight = weightOf(half, slot, nullptr);
                float* __restrict kept = half.deposits.data() + slot * stride;
                for (std::size_t j = 0; j < stride; ++j) kept[j] += weight * (sum[j] * scale - kept[j]), sum[j] = 0.0f;
            }
        });
    }

    Level level_;
    DepositLayout layout_;
    VolumeParts parts_;
    std::vector<Record> partials_;
    std::vector<Record> history_;
    double rays_ = 0.0;
};

}  // namespace clv
#endif
