// Builds a level from the scene: which cells have slots, their open volumes, and what each slot sees of its neighbours.
#ifndef CLV_CPU_BUILD_LEVEL_H
#define CLV_CPU_BUILD_LEVEL_H
#include <span>

#include "../stages/evaluate.h"
#include "cell_regions.h"
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

// `needed`: a flag a cell, x fastest in logical coordinates, or empty for all cells. Cells that are not needed get no slot.
inline Level buildLevel(const ClvVolume& volume, const SceneProbe& probe, const std::vector<std::uint8_t>& needed,
                        const ParallelFor& parallelFor, const BuildOptions& options = {}) {
    const ivec3 size = volume.resolution;
    const std::size_t cells = std::size_t(size.x) * size.y * size.z;
    Level level;
    level.volume = volume;
    level.table.assign(cells, kClvNoSlot);

    const int longest = std::max(std::max(size.x, size.y), size.z);
    const int perCell = options.linesPerCell > 0 ? options.linesPerCell : std::clamp(320 / longest, 3, 8);
    std::vector<std::vector<std::pair<uint, CellRegions>>> slabs(size.z);
    if (options.findRegions) {
        LineGrid lines(volume, {ivec3(0), size}, perCell, needed, probe, parallelFor);
        parallelFor(std::size_t(size.z), [&](std::size_t z) {
            RegionFinder finder(volume, lines);
            for (int y = 0; y < size.y; ++y) {
                for (int x = 0; x < size.x; ++x) {
                    const std::size_t flag = std::size_t(x) + std::size_t(size.x) * (y + std::size_t(size.y) * z);
                    if (!needed.empty() && !needed[flag]) continue;
                    ivec3 cell(x, y, int(z));
                    CellRegions regions = finder.find(cell);
                    if (regions.count > 0) slabs[z].emplace_back(clvCellIndex(volume, cell), regions);
                }
            }
        });
    } else {
        for (std::size_t i = 0; i < cells; ++i) {
            if (!needed.empty() && !needed[i]) continue;
            ivec3 cell(int(i) % size.x, int(i) / size.x % size.y, int(i) / (size.x * size.y));
            CellRegions regions;
            regions.count = 1;
            regions.region[0] = {volume.cellSize * volume.cellSize * volume.cellSize, clvCellCenter(volume, cell), clvCellCenter(volume, cell)};
            slabs[cell.z].emplace_back(clvCellIndex(volume, cell), regions);
        }
    }

    std::vector<vec3> inside;
    std::vector<std::uint8_t> cut(cells, 0);
    for (const auto& slab : slabs) {
        for (const auto& [cell, regions] : slab) {
            const uint first = uint(level.slots.size());
            for (int r = 0; r < regions.count; ++r) {
                level.slots.push_back({regions.region[r].centroid, regions.region[r].volume, ~0u, ~0u, cell, 0});
                inside.push_back(regions.region[r].inside);
            }
            cut[cell] = regions.cut;
            level.table[cell] = first;
            if (regions.count == 2) {
                level.table[cell] = kClvSplitBit | uint(level.splits.size());
                level.splits.push_back({regions.planeNormal, regions.planeOffset, first, first + 1, 0, 0});
            }
        }
    }
    if (!options.findRegions) return level;

    // What each slot sees of its neighbours: one ray a pair, from the lower neighbour numbers; the others mirror them.
    auto forNeighbours = [&](const ClvSlot& slot, int from, int to, auto&& visit) {
        const ivec3 cell = clvCellFromIndex(volume, slot.cell);
        for (int k = from; k < to; ++k) {
            const ivec3 other = cell + ivec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
            if (!clvCellInside(volume, other)) continue;
            const uint index = clvCellIndex(volume, other);
            const uint entry = level.table[index];
            if (entry == kClvNoSlot || !(cut[slot.cell] || cut[index])) continue;
            if (entry & kClvSplitBit) {
                visit(k, level.splits[entry & ~kClvSplitBit].frontSlot, false);
                visit(k, level.splits[entry & ~kClvSplitBit].backSlot, true);
            } else {
                visit(k, entry, false);
            }
        }
    };
    const std::size_t kPiece = 512;
    const std::size_t pieces = (level.slots.size() + kPiece - 1) / kPiece;
    auto forSlots = [&](auto&& body) {
        parallelFor(pieces, [&](std::size_t piece) {
            for (std::size_t s = piece * kPiece; s < std::min(level.slots.size(), (piece + 1) * kPiece); ++s) body(uint(s));
        });
    };
    std::vector<uvec2> lower(level.slots.size(), uvec2(~0u));
    forSlots([&](uint s) {
        forNeighbours(level.slots[s], 0, 13, [&](int k, uint other, bool back) {
            if (probe.occluded(inside[s], inside[other])) (back ? lower[s].y : lower[s].x) &= ~(1u << k);
        });
    });
    forSlots([&](uint s) {
        ClvSlot& slot = level.slots[s];
        slot.visibleFront = lower[s].x, slot.visibleBack = lower[s].y;
        const uint mine = level.table[slot.cell];
        const bool isBack = (mine & kClvSplitBit) && level.splits[mine & ~kClvSplitBit].backSlot == s;
        // The two sides of one cell never see each other.
        if (mine & kClvSplitBit) (isBack ? slot.visibleFront : slot.visibleBack) &= ~(1u << 13);
        forNeighbours(slot, 14, 27, [&](int k, uint other, bool back) {
            const uint seen = isBack ? lower[other].y : lower[other].x;
            if (!(seen >> (26 - k) & 1u)) (back ? slot.visibleBack : slot.visibleFront) &= ~(1u << k);
        });
    });
    return level;
}

}  // namespace clv
#endif
