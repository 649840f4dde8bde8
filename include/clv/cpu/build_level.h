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

    const int perCell = options.linesPerCell > 0 ? options.linesPerCell : std::clamp(int(256 / std::cbrt(double(cells))), 3, 8);
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
                    if (!regions.regions.empty()) slabs[z].emplace_back(clvCellIndex(volume, cell), std::move(regions));
                }
            }
        });
    } else {
        for (std::size_t i = 0; i < cells; ++i) {
            if (!needed.empty() && !needed[i]) continue;
            ivec3 cell(int(i) % size.x, int(i) / size.x % size.y, int(i) / (size.x * size.y));
            CellRegions regions;
            regions.regions.push_back({volume.cellSize * volume.cellSize * volume.cellSize, clvCellCenter(volume, cell), clvCellCenter(volume, cell)});
            slabs[cell.z].emplace_back(clvCellIndex(volume, cell), regions);
        }
    }

    std::vector<vec3> inside;
    std::vector<std::uint8_t> cut(cells, 0);
    for (const auto& slab : slabs) {
        for (const auto& [cell, regions] : slab) {
            const uint first = uint(level.slots.size()), root = uint(level.splits.size());
            for (const OpenRegion& region : regions.regions) {
                level.slots.push_back({region.centroid, region.volume, uvec4(~0u), cell, 0, 0, 0});
                inside.push_back(region.inside);
            }
            cut[cell] = regions.cut;
            level.table[cell] = regions.splits.empty() ? first : kClvSplitBit | root;
            auto child = [&](int index) { return index < 0 ? first + uint(-1 - index) : kClvSplitBit | (root + uint(index)); };
            for (const RegionSplit& split : regions.splits) {
                level.splits.push_back({split.plane, child(split.front), child(split.back), first, uint(regions.regions.size())});
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
            const CellSlots slots = slotsOfCell(level, entry);
            for (uint i = 0; i < slots.count; ++i) visit(k, slots.first + i, int(i));
        }
    };
    const std::size_t kPiece = 512;
    const std::size_t pieces = (level.slots.size() + kPiece - 1) / kPiece;
    auto forSlots = [&](auto&& body) {
        parallelFor(pieces, [&](std::size_t piece) {
            for (std::size_t s = piece * kPiece; s < std::min(level.slots.size(), (piece + 1) * kPiece); ++s) body(uint(s));
        });
    };
    std::vector<uvec4> lower(level.slots.size(), uvec4(~0u));
    forSlots([&](uint s) {
        // Neighbour 13 is the cell itself.
        forNeighbours(level.slots[s], 0, 14, [&](int k, uint other, int ordinal) {
            if (other != s && probe.occluded(inside[s], inside[other])) lower[s][ordinal] &= ~(1u << k);
        });
    });
    forSlots([&](uint s) {
        ClvSlot& slot = level.slots[s];
        slot.visible = lower[s];
        const uint mine = s - slotsOfCell(level, level.table[slot.cell]).first;
        forNeighbours(slot, 14, 27, [&](int k, uint other, int ordinal) {
            if (!(lower[other][int(mine)] >> (26 - k) & 1u)) slot.visible[ordinal] &= ~(1u << k);
        });
    });
    return level;
}

}  // namespace clv
#endif
