// A frame's deposits before they are merged: partial volumes that are filled at the same time, and added up slot by slot.
#ifndef CLV_CPU_PARTIAL_VOLUME_H
#define CLV_CPU_PARTIAL_VOLUME_H
#include <algorithm>
#include <array>

#include "../stages/merge.h"
#include "aligned.h"
#include "inject.h"

namespace clv {

inline constexpr std::size_t kSides = 6;  // +x -x +y -y +z -z
using SideDynamicity = std::array<float, kSides>;

struct PartialVolume {
    AlignedFloats deposits;         // DepositLayout::stride() floats a slot
    std::vector<float> dynamicity;  // kSides floats a slot, or empty where no light moves

    static std::size_t bytes(std::size_t slots, const DepositLayout& layout, bool withDynamicity) {
        return layout.bytes(slots) + (withDynamicity ? slots * sizeof(SideDynamicity) : 0);
    }
    std::size_t bytes() const { return deposits.capacity() * sizeof(float) + dynamicity.capacity() * sizeof(float); }

    void reserve(std::size_t slots, const DepositLayout& layout, bool withDynamicity) {
        deposits.reserve(slots * layout.stride());
        if (withDynamicity) dynamicity.reserve(slots * kSides);
    }
    void resize(std::size_t slots, const DepositLayout& layout, bool withDynamicity) {
        deposits.resize(slots * layout.stride());
        if (withDynamicity) dynamicity.resize(slots * kSides);
    }
    void clear() {
        std::fill(deposits.begin(), deposits.end(), 0.0f);
        std::fill(dynamicity.begin(), dynamicity.end(), 0.0f);
    }
    DepositTarget target() { return {deposits, dynamicity}; }
};

// Moves a slot's history (stride floats) towards this frame's estimate, `scale` times the sum of the partial volumes, by `weight`.
// Clears the slot in all of them.
inline void mergeDeposits(std::span<PartialVolume> partials, std::size_t slot, std::size_t stride, float scale, float weight, float* history) {
    float* __restrict sum = partials[0].deposits.data() + slot * stride;
    for (std::size_t c = 1; c < partials.size(); ++c) {
        float* __restrict other = partials[c].deposits.data() + slot * stride;
        for (std::size_t j = 0; j < stride; ++j) sum[j] += other[j], other[j] = 0.0f;
    }
    float* __restrict kept = history;
    for (std::size_t j = 0; j < stride; ++j) kept[j] = clvMergeStep(kept[j], sum[j] * scale, weight), sum[j] = 0.0f;
}

// The largest dynamicity that lit each side of a slot in this frame. Clears it.
inline SideDynamicity takeDynamicity(std::span<PartialVolume> partials, std::size_t slot) {
    SideDynamicity largest{};
    for (PartialVolume& partial : partials) {
        float* side = partial.dynamicity.data() + slot * kSides;
        for (std::size_t i = 0; i < kSides; ++i) largest[i] = std::max(largest[i], side[i]), side[i] = 0.0f;
    }
    return largest;
}

// Merges this frame's dynamicity of a slot into `kept`, kSides numbers, and returns the largest of them. Clears it in the partial volumes.
inline float mergeDynamicity(const ClvMergeSettings& merge, std::span<PartialVolume> partials, std::size_t slot, float* kept) {
    const SideDynamicity now = takeDynamicity(partials, slot);
    float largest = 0.0f;
    for (std::size_t side = 0; side < kSides; ++side) {
        kept[side] = clvMergeDynamicity(merge, kept[side], now[side]);
        largest = std::max(largest, kept[side]);
    }
    return largest;
}

}  // namespace clv
#endif
