// A reading taken apart: which cells a receiver reads, with what weight, what each of them adds, and why others add nothing.
#ifndef CLV_CPU_EXPLAIN_READING_H
#define CLV_CPU_EXPLAIN_READING_H
#include <algorithm>
#include <cmath>
#include <vector>

#include "evaluate.h"

namespace clv {

enum class TermUse {
    read,
    behind,   // left out: its open centroid lies behind the receiver's plane
    hidden,   // left out: the hub does not see it
    noSlot,   // left out: the cell is solid, or nobody was to read it
    outside,  // left out: the point of interpolation is too far from the cell
};

// A slot within reach of the lookup, or a cell without one.
struct ReadingTerm {
    ivec3 cell{0};
    uint slot = kClvNoSlot;
    TermUse use = TermUse::noSlot;
    float weight = 0.0f;        // of the interpolation, [0, 1]
    float openVolume = 0.0f;    // m^3
    float height = 0.0f;        // m, of its open centroid above the receiver's plane
    float share = 0.0f;         // 1/m^3: multiplies its deposits; 0 unless it is read
    vec3 irradiance{0.0f};      // W/m^2, what it adds: share times its deposits, read for the normal; may be negative
};

struct Reading {
    Hub hub{};
    bool hubAlone = false;           // everything in reach was left out, so the hub is read whichever side it lies on
    std::vector<ReadingTerm> terms;  // in the order of the lookup
    vec3 irradiance{0.0f};           // W/m^2: what evaluate returns, the sum of the terms clamped at 0
};

// `estimates`: deposits of the level, layout.stride() floats a slot, whose mean is read; see writeTextures.
inline Reading explainReading(const Level& level, const DepositLayout& layout, std::span<const std::span<const float>> estimates,
                              const ClvReceiver& receiver, const LookupOptions& options = {}) {
    Reading reading;
    reading.hub = findHub(level, receiver, options);
    const auto termOf = [&](const ivec3& cell, uint slot, float weight) {
        const ClvSlot& s = level.slots[slot];
        return ReadingTerm{.cell = cell, .slot = slot, .weight = weight, .openVolume = s.openVolume, .height = dot(s.openCentroid - receiver.position, receiver.normal)};
    };
    if (options.lookup != kClvLookupNearest) {
        forCellsInReach(level, reading.hub, options.lookup, [&](const ivec3& step, const vec3& offset, uint entry) {
            const ivec3 cell = reading.hub.cell + step;
            const float weight = clvLookupWeight(options.lookup, offset);
            if (entry == kClvNoSlot) {
                reading.terms.push_back({.cell = cell, .use = TermUse::noSlot, .weight = weight});
                return;
            }
            const CellSlots slots = slotsOfCell(level, entry);
            for (uint i = 0; i < slots.count; ++i) {
                ReadingTerm& term = reading.terms.emplace_back(termOf(cell, slots.first + i, weight));
                const bool culled = options.planeCulling && clvInFront(receiver, level.slots[term.slot].openCentroid) == 0;
                term.use = !(weight > 0.0f) ? TermUse::outside : !hubSees(level, reading.hub, options, step, i) ? TermUse::hidden : culled ? TermUse::behind : TermUse::read;
            }
        });
    }
    SlotWeights weights;
    lookupWeights(level, receiver, options, weights);
    reading.hubAlone = std::ranges::none_of(reading.terms, [](const ReadingTerm& term) { return term.use == TermUse::read; });
    const ClvCoefficients read = layout.read(receiver.normal);
    const float perEstimate = 1.0f / float(estimates.size());
    for (int i = 0; i < weights.count; ++i) {
        const uint slot = weights.slot[i];
        auto term = std::ranges::find(reading.terms, slot, &ReadingTerm::slot);
        if (term == reading.terms.end()) term = reading.terms.insert(term, termOf(reading.hub.cell, slot, 0.0f));
        term->use = TermUse::read;
        term->share = weights.weight[i];
        for (const auto& deposits : estimates) term->irradiance += perEstimate * readRecords(layout, deposits, {&slot, 1}, {&term->share, 1}, read);
    }
    for (const auto& deposits : estimates) reading.irradiance += perEstimate * readIrradiance(layout, deposits, weights, read);
    return reading;
}

}  // namespace clv
#endif
