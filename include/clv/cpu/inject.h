// Inject on the CPU: rays into the deposits of one level, packet by packet.
#ifndef CLV_CPU_INJECT_H
#define CLV_CPU_INJECT_H
#include <algorithm>
#include <array>
#include <iterator>
#include <span>

#include "../stages/record.h"
#include "aligned.h"
#include "packet_walk.h"
#include "walk_order.h"

namespace clv {

// Where crossings end up. `deposits` holds layout.stride() floats a slot, aligned to 64 bytes; `dynamicity` holds 6 floats a slot
// (the sides +x -x +y -y +z -z), or is empty where no light moves.
struct DepositTarget {
    std::span<float> deposits;
    std::span<float> dynamicity;
};

namespace detail {

// What each of up to 16 rays adds per metre: flux * f_k, in the order of the record. What pads a record stays 0.
struct PacketDeposits {
    alignas(64) float value[kPacketLanes][32] = {};
    alignas(64) float dynamicity[kPacketLanes][8] = {};  // a side each: the ray's, on the sides that it lights
};

// most: see clvMostFlux.
inline void packetDeposits(const DepositLayout& layout, float most, std::span<const ClvRay> rays, bool withDynamicity, PacketDeposits& out) {
    const int count = int(clvCoefficientCount(layout.storage));
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const ClvRay& ray = rays[i];
        float* value = out.value[i];
        if (!clvCarriesLight(ray)) {
            std::fill(std::begin(out.value[i]), std::end(out.value[i]), 0.0f);
            std::fill(std::begin(out.dynamicity[i]), std::end(out.dynamicity[i]), 0.0f);
            continue;
        }
        const vec3 direction = layout.frame * ray.direction;
        const ClvCoefficients c = clvDepositCoefficients(layout.storage, direction);
        const float f[9] = {c.a.x, c.a.y, c.a.z, c.a.w, c.b.x, c.b.y, c.b.z, c.b.w, c.c};
        const vec3 flux = clvChannelFlux(uint(layout.channels), ray, most);
        if (layout.channels == 1) {
            for (int k = 0; k < count; ++k) value[k] = f[k] * flux.x;
        } else {
            for (int k = 0; k < count; ++k) {
                value[3 * k] = f[k] * flux.x;
                value[3 * k + 1] = f[k] * flux.y;
                value[3 * k + 2] = f[k] * flux.z;
            }
        }
        if (withDynamicity) {
            for (int axis = 0; axis < 3; ++axis) {
                out.dynamicity[i][2 * axis] = direction[axis] < 0.0f ? ray.dynamicity : 0.0f;
                out.dynamicity[i][2 * axis + 1] = direction[axis] > 0.0f ? ray.dynamicity : 0.0f;
            }
        }
    }
}

// Starts to fetch the cache line of `p`, to be written.
inline void prefetch([[maybe_unused]] const float* p) {
#if defined(__GNUC__)
    __builtin_prefetch(p, 1);
#endif
}

// Goes down from split cells to the slots that the middles of the crossings lie in. Round by round over all that are still split,
// without branches: which side of a split a ray passes cannot be predicted.
inline void resolveSplits(const Level& level, std::span<const ClvRay> rays, CrossingBuffer& buffer) {
    int open[CrossingBuffer::kCapacity + kPacketLanes];
    int count = 0;
    for (int k = 0; k < buffer.count; ++k) {
        open[count] = k;
        count += (buffer.entry[k] & kClvSplitBit) != 0u;
    }
    while (count > 0) {
        int left = 0;
        for (int i = 0; i < count; ++i) {
            const int k = open[i];
            const ClvRay& ray = rays[buffer.lane[k]];
            const ClvSplit& split = level.splits[buffer.entry[k] & ~kClvSplitBit];
            const uint child = clvSideOfSplit(split, ray.origin + ray.direction * buffer.middle[k]);
            buffer.entry[k] = child;
            open[left] = k;
            left += (child & kClvSplitBit) != 0u;
        }
        count = left;
    }
}

template <int Stride>
inline void depositCrossings(const Level& level, std::span<const ClvRay> rays, const PacketDeposits& packet, CrossingBuffer& buffer,
                             const DepositTarget& target) {
    resolveSplits(level, rays, buffer);
    float* deposits = target.deposits.data();
    float* dynamicity = target.dynamicity.empty() ? nullptr : target.dynamicity.data();
    // Deposits that the caches near a core do not hold: only then is it worth the instructions to fetch them ahead.
    const bool far = target.deposits.size_bytes() > (std::size_t(2) << 20);
    // How many crossings ahead a record is fetched: enough to hide the way to memory.
    constexpr int kAhead = 32;
    auto fetch = [&](int k) {
        const float* record = deposits + std::size_t(buffer.entry[k]) * Stride;
        for (int line = 0; line < Stride; line += 16) prefetch(record + line);
    };
    for (int k = 0; far && k < std::min(kAhead, buffer.count); ++k) fetch(k);
    for (int k = 0; k < buffer.count; ++k) {
        if (far && k + kAhead < buffer.count) fetch(k + kAhead);
        const uint slot = buffer.entry[k], lane = buffer.lane[k];
        const float weight = buffer.weight[k];
        float* __restrict record = deposits + std::size_t(slot) * Stride;
        const float* __restrict add = packet.value[lane];
        // Unrolled as a whole, short records would not be made into vectors.
#pragma GCC unroll 1
        for (int j = 0; j < Stride; ++j) record[j] += add[j] * weight;
        if (dynamicity) {
            float* side = dynamicity + std::size_t(slot) * 6;
            for (int j = 0; j < 6; ++j) side[j] = std::max(side[j], packet.dynamicity[lane][j]);
        }
    }
    buffer.count = 0;
}

template <int Stride>
void injectStrided(const Level& level, const DepositLayout& layout, uint rule, std::span<const ClvRay> rays, const DepositTarget& target) {
    PacketDeposits packet;
    CrossingBuffer buffer;
    WalkOrder order;
    std::array<ClvRay, kPacketLanes> lanes;
    const float most = clvMostFlux(rule, level.volume.cellSize);
    for (std::size_t begin = 0; begin < rays.size(); begin += WalkOrder::kBlock) {
        const auto block = rays.subspan(begin, std::min(WalkOrder::kBlock, rays.size() - begin));
        order.sort(level.volume, block);
        for (std::size_t first = 0; first < block.size(); first += kPacketLanes) {
            const auto filled = std::span(lanes).first(std::min<std::size_t>(kPacketLanes, block.size() - first));
            for (std::size_t i = 0; i < filled.size(); ++i) filled[i] = block[order[first + i]];
            packetDeposits(layout, most, filled, !target.dynamicity.empty(), packet);
            auto flush = [&](CrossingBuffer& full) { depositCrossings<Stride>(level, filled, packet, full, target); };
            walkPacket(level, rule, filled, buffer, flush);
            flush(buffer);
        }
    }
}

inline void injectPiece(const Level& level, const DepositLayout& layout, uint rule, std::span<const ClvRay> rays, const DepositTarget& target) {
    switch (layout.stride()) {
        case 8: return injectStrided<8>(level, layout, rule, rays, target);
        case 16: return injectStrided<16>(level, layout, rule, rays, target);
        case 24: return injectStrided<24>(level, layout, rule, rays, target);
        default: return injectStrided<32>(level, layout, rule, rays, target);
    }
}

}  // namespace detail

// Rays that add to the same floats before these are put aside: a float stops at 2^24 times an addend, and of 2^20 like ones it loses 2e-5.
inline constexpr std::size_t kMostInOneSum = std::size_t(1) << 20;

// Adds the rays' deposits to `target`. Serial: the order follows from the rays, so the sums are the same to the last bit from run to run.
// Different targets may be filled from different threads. Beyond kMostInOneSum rays it allocates as much as the deposits.
//
// Of rays that are r times dimmer than the others in a cell, a sum loses more and more from some 2^24 / r bright ones on: rays that differ by more
// than a hundred belong in targets of their own, which are added up afterwards. Those that the library draws carry equal flux.
inline void inject(const Level& level, const DepositLayout& layout, uint rule, std::span<const ClvRay> rays, const DepositTarget& target) {
    if (rays.size() <= kMostInOneSum) return detail::injectPiece(level, layout, rule, rays, target);
    AlignedFloats sums(target.deposits.begin(), target.deposits.end());
    for (std::size_t first = 0; first < rays.size(); first += kMostInOneSum) {
        std::ranges::fill(target.deposits, 0.0f);
        detail::injectPiece(level, layout, rule, rays.subspan(first, std::min(kMostInOneSum, rays.size() - first)), target);
        for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += target.deposits[k];
    }
    std::ranges::copy(sums, target.deposits.begin());
}

}  // namespace clv
#endif
