#include "bindings/volume_file/moving_cascades.h"

#include <algorithm>

namespace clv {
namespace {

// A level without scroll and without the gaps that moving leaves between its slots.
struct TidyLevel {
    Level level;
    std::vector<uint> sources;  // slots of the level that it came from, a slot each

    explicit TidyLevel(const Level& from) {
        level.volume = from.volume;
        level.volume.scroll = ivec3(0);
        level.table.assign(from.cellCount(), kClvNoSlot);
        for (std::size_t cell = 0; cell < from.cellCount(); ++cell) {
            const uint entry = from.table[clvCellIndex(from.volume, clvCellFromIndex(level.volume, uint(cell)))];
            if (entry == kClvNoSlot) continue;
            const CellSlots slots = slotsOfCell(from, entry);
            const uint first = uint(level.slots.size());
            for (uint slot = slots.first; slot < slots.first + slots.count; ++slot) {
                sources.push_back(slot);
                level.slots.push_back(from.slots[slot]);
                level.slots.back().cell = uint(cell);
            }
            level.table[cell] = copyEntry(from, entry, slots, first);
        }
    }

private:
    uint copyEntry(const Level& from, uint entry, const CellSlots& slots, uint first) {
        if (!clvIsSplit(entry)) return entry - slots.first + first;
        const std::size_t copy = level.splits.size();
        ClvSplit split = from.splits[entry & ~kClvSplitBit];
        level.splits.push_back(split);
        split.front = copyEntry(from, split.front, slots, first);
        split.back = copyEntry(from, split.back, slots, first);
        split.firstSlot = first;
        split.slotCount = slots.count;
        level.splits[copy] = split;
        return uint(copy) | kClvSplitBit;
    }
};

std::vector<float> gather(std::span<const float> from, std::span<const uint> slots, std::size_t perSlot) {
    std::vector<float> values;
    values.reserve(slots.size() * perSlot);
    for (const uint slot : slots) values.insert(values.end(), from.begin() + std::ptrdiff_t(slot * perSlot), from.begin() + std::ptrdiff_t((slot + 1) * perSlot));
    return values;
}

}  // namespace

BakedCascade cascadeFrom(const MovingVolume& volume, const DepositLayout& layout, double raysPerFrame) {
    TidyLevel tidy(volume.level());
    BakedCascade cascade{std::move(tidy.level), {gather(volume.history(), tidy.sources, std::size_t(layout.stride()))}, gather(volume.frames(), tidy.sources, 1), {}};
    for (float& samples : cascade.samples) samples = float(samples * raysPerFrame);
    if (!volume.dynamicity().empty()) cascade.dynamicity = gather(volume.dynamicity(), tidy.sources, kSides);
    return cascade;
}

void keepCascades(const MovingLighting& lighting, double raysPerFrame, BakedVolume& volume) {
    volume.marginCells = lighting.cascades().marginCells;
    volume.blendCells = lighting.cascades().blendCells;
    volume.cascades.clear();
    for (const MovingVolume& moving : lighting.volumes()) volume.cascades.push_back(cascadeFrom(moving, volume.layout, raysPerFrame));
}

}  // namespace clv
