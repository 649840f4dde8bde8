// The slots of a level in groups of eight that lie in one brick: what the lanes of the GPU's gather fill together.
#ifndef CLV_CPU_BRICK_SLOTS_H
#define CLV_CPU_BRICK_SLOTS_H
#include <algorithm>
#include <array>
#include <numeric>

#include "../stages/gather.h"
#include "level.h"

namespace clv {

struct BrickSlots {
    std::vector<uint> slots;  // kClvBrickLanes a group: slots, then kClvNoSlot where a brick has no more
    // Where the groups end whose cells have at most 0, 1, ... kClvMostSplits splits on the way to a slot: groups are sorted by that.
    std::array<uint, kClvMostSplits + 1> groupEnds{};

    std::vector<uint> mask;   // a bit a brick: whether it has any

    uint groupCount() const { return groupEnds.back(); }
};

// Splits on the way from a table entry to a slot, at most.
inline int splitDepth(const Level& level, uint entry) {
    if (!clvIsSplit(entry)) return 0;
    const ClvSplit& split = level.splits[entry & ~kClvSplitBit];
    return 1 + std::max(splitDepth(level, split.front), splitDepth(level, split.back));
}

inline BrickSlots brickSlots(const Level& level) {
    struct Place {
        uint brick, slot;
        int depth;
    };
    std::vector<Place> places;
    for (uint slot = 0; slot < level.slots.size(); ++slot) {
        const uint cell = level.slots[slot].cell;
        places.push_back({clvBrickOfCell(level.volume, clvCellFromIndex(level.volume, cell)), slot, splitDepth(level, level.table[cell])});
    }
    // Whole cells before split ones: a brick that needs several groups then has few that must look at planes.
    std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.brick != b.brick ? a.brick < b.brick : a.depth < b.depth; });
    struct Group {
        std::size_t first, count;
        int depth;
    };
    std::vector<Group> groups;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const bool opens = groups.empty() || groups.back().count == kClvBrickLanes || places[i - 1].brick != places[i].brick;
        if (opens) groups.push_back({i, 0, 0});
        ++groups.back().count;
        groups.back().depth = places[i].depth;
    }
    std::stable_sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) { return a.depth < b.depth; });
    BrickSlots result;
    result.mask.resize(clvBrickMaskWords(level.volume));
    for (const Place& place : places) result.mask[place.brick / 32u] |= 1u << place.brick % 32u;
    result.slots.assign(groups.size() * kClvBrickLanes, kClvNoSlot);
    for (std::size_t g = 0; g < groups.size(); ++g) {
        for (std::size_t k = 0; k < groups[g].count; ++k) result.slots[g * kClvBrickLanes + k] = places[groups[g].first + k].slot;
        ++result.groupEnds[std::size_t(groups[g].depth)];
    }
    std::partial_sum(result.groupEnds.begin(), result.groupEnds.end(), result.groupEnds.begin());
    return result;
}

}  // namespace clv
#endif
