// Evaluate on the CPU: which slots a receiver reads, with what weights, and what comes out.
#ifndef CLV_CPU_EVALUATE_H
#define CLV_CPU_EVALUATE_H
#include <array>
#include <span>

#include "../stages/evaluate.h"
#include "level.h"

namespace clv {

struct LookupOptions {
    uint lookup = kClvLookupLinearFit;
    bool planeCulling = true;
    bool visibility = true;   // leave out slots that the receiver's own slot does not see
    float ridge = kClvFitRidge;  // cells^2, [1e-6, 1e6]: its third power is a float of full precision
};

// What is wrong with the options, in words; empty if nothing is.
inline std::string validate(const LookupOptions& options) {
    if (options.lookup > kClvLookupLinearFit) return "lookup: it must be one of kClvLookup...";
    if (!liesIn(options.ridge, 1e-6, 1e6)) return "lookup: ridge must lie in [1e-6, 1e6]";
    return {};
}

// The slots that a receiver reads. E = sum of weight[i] * (record of slot[i], read for the normal).
struct SlotWeights {
    static constexpr int kCapacity = 27 * int(kClvMostSlots);
    int count = 0;
    std::array<uint, kCapacity> slot;
    std::array<float, kCapacity> weight;  // 1/m^3
};

namespace detail {

// The slot of a cell that holds `position`, or kClvNoSlot.
inline uint slotAt(const Level& level, const ivec3& cell, const vec3& position) {
    if (!clvCellInside(level.volume, cell)) return kClvNoSlot;
    return slotAtPosition(level, level.table[clvCellIndex(level.volume, cell)], position);
}

// Whether a slot sees slot `ordinal` of the neighbour at `step`.
inline bool sees(const ClvSlot& slot, const ivec3& step, uint ordinal) {
    return (slot.visible[int(ordinal)] & clvNeighbourBit(step)) != 0u;
}

}  // namespace detail

// Where a receiver reads from: the cell around which interpolation runs, its slot, and the point on which it is centred.
struct Hub {
    ivec3 cell;
    uint slot;     // kClvNoSlot: the cell has none
    vec3 center;   // m
};

// Half a cell in front of the surface, unless a wall stands between: then the surface's own cell.
inline Hub findHub(const Level& level, const ClvReceiver& receiver, const LookupOptions& options) {
    const ClvVolume& v = level.volume;
    const float h = v.cellSize;
    const vec3 ahead = receiver.position + receiver.normal * (kClvLookupOffset * h);
    const ivec3 aheadCell = clvClampCell(v, clvCellFromPosition(v, ahead));
    const uint aheadSlot = detail::slotAt(level, aheadCell, ahead);
    const ivec3 ownCell = clvClampCell(v, clvCellFromPosition(v, receiver.position + receiver.normal * (kClvHomeOffset * h)));
    if (ownCell == aheadCell || !options.visibility) return {aheadCell, aheadSlot, ahead};
    const vec3 side = receiver.position + receiver.normal * (kClvSideOffset * h);
    const uint ownSlot = detail::slotAt(level, ownCell, side);
    if (ownSlot == kClvNoSlot) return {aheadCell, aheadSlot, ahead};
    if (aheadSlot != kClvNoSlot) {
        // A sliver of open space in front of the surface may have no slot of its own: what the cell has then lies behind the receiver.
        const bool ownBehind = clvInFront(receiver, level.slots[ownSlot].openCentroid) == 0;
        if (ownBehind && clvInFront(receiver, level.slots[aheadSlot].openCentroid) == 1) return {aheadCell, aheadSlot, ahead};
        const uint ordinal = aheadSlot - slotsOfCell(level, level.table[clvCellIndex(v, aheadCell)]).first;
        if (detail::sees(level.slots[ownSlot], aheadCell - ownCell, ordinal)) return {aheadCell, aheadSlot, ahead};
    }
    return {ownCell, ownSlot, receiver.position + receiver.normal * (kClvHomeOffset * h)};
}

// Calls visit(step, offset, entry) for the cells of the grid around which a lookup may reach: 8 of trilinear interpolation, from the cell
// whose centre is below the hub's point to the next, or 27. step: from the hub's cell; offset: of the cell's centre from the hub's
// point, cells; entry: of the cell table.
template <class Visit>
void forCellsInReach(const Level& level, const Hub& hub, uint lookup, Visit&& visit) {
    const ClvVolume& v = level.volume;
    const vec3 fromCenter = (hub.center - clvCellCenter(v, hub.cell)) * (1.0f / v.cellSize);
    ivec3 lo(-1), hi(1);
    if (lookup != kClvLookupLinearFit) {
        for (int axis = 0; axis < 3; ++axis) (fromCenter[axis] < 0.0f ? hi : lo)[axis] = 0;
    }
    for (int dz = lo.z; dz <= hi.z; ++dz) {
        for (int dy = lo.y; dy <= hi.y; ++dy) {
            for (int dx = lo.x; dx <= hi.x; ++dx) {
                const ivec3 step(dx, dy, dz);
                const ivec3 cell = hub.cell + step;
                if (clvCellInside(v, cell)) visit(step, vec3(step) - fromCenter, level.table[clvCellIndex(v, cell)]);
            }
        }
    }
}

// Whether the hub sees slot `ordinal` of the cell at `step`.
inline bool hubSees(const Level& level, const Hub& hub, const LookupOptions& options, const ivec3& step, uint ordinal) {
    return !options.visibility || hub.slot == kClvNoSlot || detail::sees(level.slots[hub.slot], step, ordinal);
}

// Depends on geometry alone, so that a still receiver may keep its weights.
inline void lookupWeights(const Level& level, const ClvReceiver& receiver, const LookupOptions& options, SlotWeights& out) {
    const float inverseCell = 1.0f / level.volume.cellSize;
    out.count = 0;
    const Hub hub = findHub(level, receiver, options);
    if (options.lookup == kClvLookupNearest) {
        if (hub.slot == kClvNoSlot) return;
        out.slot[0] = hub.slot, out.weight[0] = 1.0f / level.slots[hub.slot].openVolume, out.count = 1;
        return;
    }
    const bool fitting = options.lookup == kClvLookupLinearFit;
    std::array<vec3, SlotWeights::kCapacity> x;
    ClvFit fit = clvFitBegin();
    auto add = [&](uint slot, float weight) {
        const ClvSlot& s = level.slots[slot];
        if (options.planeCulling && clvInFront(receiver, s.openCentroid) == 0) return;
        const int i = out.count++;
        out.slot[i] = slot;
        out.weight[i] = weight;
        x[i] = (s.openCentroid - receiver.position) * inverseCell;
        clvFitAdd(fit, weight * s.openVolume, x[i]);
    };
    forCellsInReach(level, hub, options.lookup, [&](const ivec3& step, const vec3& offset, uint entry) {
        if (entry == kClvNoSlot) return;
        const float weight = clvLookupWeight(options.lookup, offset);
        if (!(weight > 0.0f)) return;
        const CellSlots slots = slotsOfCell(level, entry);
        for (uint i = 0; i < slots.count; ++i) {
            if (hubSees(level, hub, options, step, i)) add(slots.first + i, weight);
        }
    });
    if (!(fit.weight > 0.0f)) {
        // Everything was culled: the hub alone, whichever side its centroid lies on.
        out.count = 0;
        if (hub.slot == kClvNoSlot) return;
        out.slot[0] = hub.slot, out.weight[0] = 1.0f / level.slots[hub.slot].openVolume, out.count = 1;
        return;
    }
    const vec3 slope = clvFitSolve(fit, options.ridge);
    for (int i = 0; i < out.count; ++i) {
        out.weight[i] = fitting ? clvFitShare(fit, slope, out.weight[i], x[i]) : out.weight[i] / fit.weight;
    }
}

namespace detail {

// sum[j] = sum over i of weight[i] * deposits[slot[i] * Stride + j].
template <int Stride>
inline void weighRecords(std::span<const float> deposits, std::span<const uint> slots, std::span<const float> weights, float* out) {
    alignas(64) float sum[Stride] = {};
    for (std::size_t i = 0; i < slots.size(); ++i) {
        const float* __restrict record = deposits.data() + std::size_t(slots[i]) * Stride;
        const float w = weights[i];
        for (int j = 0; j < Stride; ++j) sum[j] += record[j] * w;
    }
    for (int j = 0; j < Stride; ++j) out[j] = sum[j];
}

}  // namespace detail

// The sum over i of weights[i] (1/m^3) times the record of slots[i], layout.stride() floats a slot, read for the normal, W/m^2: it may be
// negative where a storage rings. A scene without colour gives three equal channels.
inline vec3 readRecords(const DepositLayout& layout, std::span<const float> deposits, std::span<const uint> slots,
                        std::span<const float> weights, const ClvCoefficients& read) {
    alignas(64) float sum[32];
    switch (layout.stride()) {
        case 8: detail::weighRecords<8>(deposits, slots, weights, sum); break;
        case 16: detail::weighRecords<16>(deposits, slots, weights, sum); break;
        case 24: detail::weighRecords<24>(deposits, slots, weights, sum); break;
        default: detail::weighRecords<32>(deposits, slots, weights, sum); break;
    }
    const float r[9] = {read.a.x, read.a.y, read.a.z, read.a.w, read.b.x, read.b.y, read.b.z, read.b.w, read.c};
    vec3 irradiance(0.0f);
    for (int k = 0; k < int(clvCoefficientCount(layout.storage)); ++k) {
        for (int c = 0; c < 3; ++c) irradiance[c] += r[k] * sum[layout.channels == 1 ? k : 3 * k + c];
    }
    return irradiance;
}

// Irradiance, W/m^2: the same, not negative.
inline vec3 readIrradiance(const DepositLayout& layout, std::span<const float> deposits, std::span<const uint> slots,
                           std::span<const float> weights, const ClvCoefficients& read) {
    return clvIrradianceFromSum(readRecords(layout, deposits, slots, weights, read));
}
inline vec3 readIrradiance(const DepositLayout& layout, std::span<const float> deposits, const SlotWeights& weights,
                           const ClvCoefficients& read) {
    const auto count = std::size_t(weights.count);
    return readIrradiance(layout, deposits, {weights.slot.data(), count}, {weights.weight.data(), count}, read);
}

}  // namespace clv
#endif
