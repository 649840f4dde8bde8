// A level on the host: the grid, its cell table, splits and slots; and where the deposits of a slot lie in memory.
#ifndef CLV_CPU_LEVEL_H
#define CLV_CPU_LEVEL_H
#include <cstddef>
#include <string>
#include <vector>

#include "../data/cell.h"
#include "../data/light_volume.h"
#include "../plan/number_check.h"
#include "../stages/find_slot.h"

namespace clv {

struct Level {
    ClvVolume volume;
    std::vector<uint> table;       // a cell each: slot, split or kClvNoSlot
    std::vector<ClvSplit> splits;
    std::vector<ClvSlot> slots;

    std::size_t cellCount() const { return table.size(); }
    // Bytes of the tables; deposits come on top (DepositLayout::bytes).
    std::size_t bytes() const {
        return table.size() * sizeof(uint) + splits.size() * sizeof(ClvSplit) + slots.size() * sizeof(ClvSlot);
    }
};

struct CellSlots {
    uint first, count;
};

// The slots of a cell whose table entry is not kClvNoSlot.
inline CellSlots slotsOfCell(const Level& level, uint entry) {
    if (!(entry & kClvSplitBit)) return {entry, 1};
    const ClvSplit& root = level.splits[entry & ~kClvSplitBit];
    return {root.firstSlot, root.slotCount};
}

// The slot that holds a position in the cell with this table entry; kClvNoSlot stays kClvNoSlot.
inline uint slotAtPosition(const Level& level, uint entry, const vec3& position) {
    while (entry != kClvNoSlot && (entry & kClvSplitBit)) {
        entry = clvSideOfSplit(level.splits[entry & ~kClvSplitBit], position);
    }
    return entry;
}

// One record a slot: coefficient k of channel c at index k * channels + c, padded to whole vectors of 8 floats.
struct DepositLayout {
    uint storage = kClvStorageCube9;
    int channels = 3;  // 3, or 1 in a scene without colour
    mat3 frame{1.0f};  // orthonormal, rows the axes along which directions are kept; see plan/direction_frame.h

    int values() const { return int(clvCoefficientCount(storage)) * channels; }
    int stride() const { return (values() + 7) / 8 * 8; }  // floats
    std::size_t bytes(std::size_t slots) const { return slots * std::size_t(stride()) * sizeof(float); }
    // How a record is read for a normal, in the space of the volume.
    ClvCoefficients read(const vec3& normal) const { return clvReadCoefficients(storage, frame * normal); }
};

// What is wrong with the layout, in words; empty if nothing is.
inline std::string validate(const DepositLayout& layout) {
    if (layout.storage > kClvStorageSh2) return "deposits: storage must be one of kClvStorage...";
    if (layout.channels != 1 && layout.channels != 3) return "deposits: channels must be 1 or 3";
    const mat3 product = layout.frame * glm::transpose(layout.frame);
    for (int i = 0; i < 9; ++i) {
        const double expected = i % 4 == 0 ? 1.0 : 0.0;
        if (!liesIn(product[i / 3][i % 3], expected - 1e-4, expected + 1e-4)) return "deposits: frame must be orthonormal";
    }
    return {};
}

// Number of cells along x, y and z, and their place, so that cubes of side cbrt(volume of the bounds) / n cover the bounds.
// `shift`, [0, 1) a component, moves the grid by a fraction of a cell.
inline ClvVolume volumeOverBounds(const vec3& lo, const vec3& hi, int n, uint storage, const vec3& shift = vec3(0.0f)) {
    vec3 extent = hi - lo;
    float longest = std::max(std::max(extent.x, extent.y), extent.z);
    // A flat scene still fills a layer of cells.
    extent = glm::max(extent, vec3(std::max(longest * 1e-2f, 1e-30f)));
    ClvVolume volume{};
    volume.cellSize = float(std::cbrt(double(extent.x) * extent.y * extent.z) / n);
    volume.storage = storage;
    // Air around the bounds, in cells, so that surfaces on the rim have open space in front of them too.
    const float rim = 0.5f;
    for (int axis = 0; axis < 3; ++axis) {
        volume.origin[axis] = lo[axis] - volume.cellSize * (rim + shift[axis]);
        volume.resolution[axis] = int(std::ceil(extent[axis] / volume.cellSize + 2 * rim + shift[axis]));
    }
    return volume;
}

}  // namespace clv
#endif
