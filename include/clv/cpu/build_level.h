// Builds a level from the scene: which cells have slots, their open volumes, and what each slot sees of its neighbours.
#ifndef CLV_CPU_BUILD_LEVEL_H
#define CLV_CPU_BUILD_LEVEL_H
#include <functional>
#include <span>

#include "../stages/evaluate.h"
#include "box_survey.h"
#include "level.h"

namespace clv {

struct BuildOptions {
    int linesPerCell = 0;     // lines that probe a cell, an axis: their square; 0: finer for coarser grids
    bool findRegions = true;  // false: every cell is one open slot, as if there were no geometry
};

// Flags the cells that lookups at these receivers can read: the 27 around the point half a cell in front of each surface.
inline std::vector<std::uint8_t> neededCells(const ClvVolume& volume, std::span<const ClvReceiver> receivers) {
    std::vector<std::uint8_t> needed(std::size_t(volume.resolution.x) * volume.resolution.y * volume.resolution.z, 0);
    for (const ClvReceiver& receiver : receivers) {
        for (float offset : {kClvHomeOffset, kClvLookupOffset}) {
            ivec3 hub = clvClampCell(volume, clvCellFromPosition(volume, receiver.position + receiver.normal * (offset * volume.cellSize)));
            ivec3 lo = clvClampCell(volume, hub - ivec3(1)), hi = clvClampCell(volume, hub + ivec3(1));
            for (int z = lo.z; z <= hi.z; ++z)
                for (int y = lo.y; y <= hi.y; ++y)
                    for (int x = lo.x; x <= hi.x; ++x)
                        needed[std::size_t(x) + std::size_t(volume.resolution.x) * (y + std::size_t(volume.resolution.y) * z)] = 1;
        }
    }
    return needed;
}

// What is known of a level while it is built, beyond what it stores.
struct LevelSketch {
    std::vector<std::uint8_t> cut;  // a cell each: a surface crosses it
    std::vector<vec3> inside;       // a slot each: a point of its region, m
    std::vector<uvec4> lower;       // a slot each: ClvSlot::visible for its own cell and the neighbours of lower number

    void resizeSlots(std::size_t count) {
        inside.resize(count);
        lower.resize(count, uvec4(~0u));
    }
};

// Writes what was found in a cell: its regions into the slots from firstSlot on, its splits from firstSplit on, which must exist.
inline void storeCell(Level& level, LevelSketch& sketch, uint cell, bool cut, std::span<const OpenRegion> regions,
                      std::span<const RegionSplit> splits, uint firstSlot, uint firstSplit) {
    for (std::size_t i = 0; i < regions.size(); ++i) {
        level.slots[firstSlot + i] = {regions[i].centroid, regions[i].volume, uvec4(~0u), cell, 0, 0, 0};
        sketch.inside[firstSlot + i] = regions[i].inside;
    }
    sketch.cut[cell] = cut;
    level.table[cell] = splits.empty() ? firstSlot : kClvSplitBit | firstSplit;
    auto child = [&](int index) { return index < 0 ? firstSlot + uint(-1 - index) : kClvSplitBit | (firstSplit + uint(index)); };
    for (std::size_t i = 0; i < splits.size(); ++i) {
        level.splits[firstSplit + i] = {splits[i].plane, child(splits[i].front), child(splits[i].back), firstSlot, uint(regions.size())};
    }
}

// Calls visit(k, other, ordinal) for the slots of neighbours [from, to) of a slot's cell, wherever one of the two is cut.
template <class Visit>
void forNeighbourSlots(const Level& level, const LevelSketch& sketch, uint slot, int from, int to, Visit&& visit) {
    const uint mine = level.slots[slot].cell;
    const ivec3 cell = clvCellFromIndex(level.volume, mine);
    for (int k = from; k < to; ++k) {
        const ivec3 other = cell + ivec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
        if (!clvCellInside(level.volume, other)) continue;
        const uint index = clvCellIndex(level.volume, other);
        const uint entry = level.table[index];
        if (entry == kClvNoSlot || !(sketch.cut[mine] || sketch.cut[index])) continue;
        const CellSlots slots = slotsOfCell(level, entry);
        for (uint i = 0; i < slots.count; ++i) visit(k, slots.first + i, int(i));
    }
}

// What a slot sees of its neighbours: one ray a pair, from the one of higher number. Neighbour 13 is the cell itself.
inline void seeLowerNeighbours(const Level& level, LevelSketch& sketch, uint slot, const SceneProbe& probe) {
    uvec4 seen(~0u);
    forNeighbourSlots(level, sketch, slot, 0, 14, [&](int k, uint other, int ordinal) {
        if (other != slot && probe.occluded(sketch.inside[slot], sketch.inside[other])) seen[ordinal] &= ~(1u << k);
    });
    sketch.lower[slot] = seen;
}

// The rest mirrors what the neighbours of higher number have seen, so all of them must have looked before.
inline void mirrorHigherNeighbours(Level& level, const LevelSketch& sketch, uint slot) {
    uvec4 seen = sketch.lower[slot];
    const uint mine = slot - slotsOfCell(level, level.table[level.slots[slot].cell]).first;
    forNeighbourSlots(level, sketch, slot, 14, 27, [&](int k, uint other, int ordinal) {
        if (!(sketch.lower[other][int(mine)] >> (26 - k) & 1u)) seen[ordinal] &= ~(1u << k);
    });
    level.slots[slot].visible = seen;
}

// `needed`: a flag a cell, x fastest in logical coordinates, or empty for all cells. Cells that are not needed get no slot.
inline Level buildLevel(const ClvVolume& volume, const SceneProbe& probe, const std::vector<std::uint8_t>& needed,
                        const ParallelFor& parallelFor, const BuildOptions& options = {}) {
    const CellBox all{ivec3(0), volume.resolution};
    const std::size_t cells = cellsInBox(all);
    Level level;
    level.volume = volume;
    level.table.assign(cells, kClvNoSlot);
    LevelSketch sketch;
    sketch.cut.assign(cells, 0);

    auto append = [&](const ivec3& cell, bool cut, std::span<const OpenRegion> regions, std::span<const RegionSplit> splits) {
        const std::size_t slot = level.slots.size(), split = level.splits.size();
        level.slots.resize(slot + regions.size());
        level.splits.resize(split + splits.size());
        sketch.resizeSlots(slot + regions.size());
        storeCell(level, sketch, clvCellIndex(volume, cell), cut, regions, splits, uint(slot), uint(split));
    };
    if (!options.findRegions) {
        const float cellVolume = volume.cellSize * volume.cellSize * volume.cellSize;
        for (std::size_t i = 0; i < cells; ++i) {
            const ivec3 cell = cellOfBox(all, i);
            const OpenRegion whole{cellVolume, clvCellCenter(volume, cell), clvCellCenter(volume, cell)};
            if (needed.empty() || needed[i]) append(cell, false, std::span(&whole, 1), {});
        }
        return level;
    }
    // Where walls meet, lines along either of them measure the other to a line's distance only: with four a cell, points within half a
    // cell of a corner read a tenth less than they receive; with eight, a hundredth.
    const int linesPerCell = options.linesPerCell > 0 ? options.linesPerCell : std::clamp(int(512 / std::cbrt(double(cells))), 4, 12);
    BoxSurvey survey;
    survey.run(volume, all, linesPerCell, needed, probe, parallelFor);
    survey.forEach(append);

    const std::size_t kPiece = 512;
    auto forSlots = [&](auto&& body) {
        parallelFor((level.slots.size() + kPiece - 1) / kPiece, [&](std::size_t piece) {
            for (std::size_t s = piece * kPiece; s < std::min(level.slots.size(), (piece + 1) * kPiece); ++s) body(uint(s));
        });
    };
    forSlots([&](uint slot) { seeLowerNeighbours(level, sketch, slot, probe); });
    forSlots([&](uint slot) { mirrorHigherNeighbours(level, sketch, slot); });
    return level;
}

}  // namespace clv
#endif
