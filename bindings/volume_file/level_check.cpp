#include "bindings/volume_file/level_check.h"

#include <cmath>

#include <fmt/format.h>

namespace clv {
namespace {

bool isFinite(const vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Whether the tree below an entry ends, within the depth that readers walk, in slots [first, first + count).
bool endsInSlots(const Level& level, uint entry, const CellSlots& slots, int depth) {
    if (entry == kClvNoSlot) return false;
    if (!clvIsSplit(entry)) return entry - slots.first < slots.count;
    const uint index = entry & ~kClvSplitBit;
    if (depth == kClvMostSplits || index >= level.splits.size()) return false;
    const ClvSplit& split = level.splits[index];
    const bool plane = isFinite(vec3(split.plane)) && std::isfinite(split.plane.w);
    return plane && endsInSlots(level, split.front, slots, depth + 1) && endsInSlots(level, split.back, slots, depth + 1);
}

}  // namespace

std::string problemOf(const Level& level) {
    std::size_t owned = 0;
    for (std::size_t cell = 0; cell < level.table.size(); ++cell) {
        const uint entry = level.table[cell];
        if (entry == kClvNoSlot) continue;
        if (clvIsSplit(entry) && (entry & ~kClvSplitBit) >= level.splits.size()) return fmt::format("cell {}: expected a split below {}", cell, level.splits.size());
        const CellSlots slots = slotsOfCell(level, entry);
        if (slots.count < 1 || slots.count > kClvMostSlots || slots.first > level.slots.size() || level.slots.size() - slots.first < slots.count)
            return fmt::format("cell {}: expected 1 to {} of {} slots", cell, kClvMostSlots, level.slots.size());
        if (!endsInSlots(level, entry, slots, 0)) return fmt::format("cell {}: expected splits that end in slots of that cell", cell);
        for (uint slot = slots.first; slot < slots.first + slots.count; ++slot) {
            if (level.slots[slot].cell != cell) return fmt::format("slot {}: expected one cell that it belongs to", slot);
        }
        owned += slots.count;
    }
    if (owned != level.slots.size()) return fmt::format("expected a cell for each of {} slots, found {}", level.slots.size(), owned);
    for (std::size_t slot = 0; slot < level.slots.size(); ++slot) {
        const ClvSlot& s = level.slots[slot];
        if (!(s.openVolume > 0.0f) || !std::isfinite(s.openVolume)) return fmt::format("slot {}: expected an open volume above 0", slot);
        if (!isFinite(s.openCentroid)) return fmt::format("slot {}: expected a finite centroid", slot);
    }
    return {};
}

}  // namespace clv
