// A level that follows the camera: when it moves, only the cells that it newly covers are analysed, and nothing is copied.
//
// A cell of the world keeps its place in the cell table, and its slots, for as long as the level covers it. What is found in it
// depends on the cell alone, to the last bit, not on the way that the level took.
#ifndef CLV_CPU_MOVING_LEVEL_H
#define CLV_CPU_MOVING_LEVEL_H
#include "../plan/cascade_placement.h"
#include "block_pool.h"
#include "build_level.h"

namespace clv {

struct MovingLevelSettings {
    ivec3 resolution{32};     // cells an axis
    uint storage = kClvStorageCube9;
    glm::dvec3 anchor{0.0};   // m, world space: all positions of the level, and those of the probe, are relative to it
    int linesPerCell = 4;     // lines that probe a cell, an axis: their square
    float slotsPerCell = 1.5f;  // slots for which memory is taken at once; a scene that needs more makes the arrays grow
};

class MovingLevel {
public:
    // Covers nothing until it is moved for the first time.
    explicit MovingLevel(const MovingLevelSettings& settings) : settings_(settings) {
        const std::size_t cells = cellsOf(settings), slots = slotsOf(settings);
        level_.table.assign(cells, kClvNoSlot);
        level_.slots.reserve(slots);
        level_.splits.reserve(splitsOf(settings));
        sketch_.cut.assign(cells, 0);
        sketch_.inside.reserve(slots);
        sketch_.lower.reserve(slots);
    }

    const Level& level() const { return level_; }
    // A point of a slot's open region, m.
    const vec3& inside(uint slot) const { return sketch_.inside[slot]; }

    static std::size_t cellsOf(const MovingLevelSettings& settings) { return cellsInBox({ivec3(0), settings.resolution}); }
    // Slots for which memory is taken at once.
    static std::size_t slotsOf(const MovingLevelSettings& settings) {
        return std::size_t(std::ceil(double(cellsOf(settings)) * settings.slotsPerCell));
    }
    // Bytes of the tables, before the level is made. What the analysis works with comes on top, and grows with the surfaces that
    // the exposed cells hold.
    static std::size_t bytes(const MovingLevelSettings& settings) {
        return cellsOf(settings) * kCellBytes + slotsOf(settings) * kSlotBytes + splitsOf(settings) * sizeof(ClvSplit);
    }
    std::size_t bytes() const {
        return level_.table.capacity() * kCellBytes + level_.slots.capacity() * kSlotBytes + level_.splits.capacity() * sizeof(ClvSplit);
    }

    // Goes to its new place. The cells that this exposes still hold what slid out of their storage, until fill() is called.
    void moveTo(const PlacedCascade& placed) {
        const ivec3 moved = cascadeScroll(placed_, placed);
        placed_ = placed;
        level_.volume = volumeFromCascade(placed, settings_.anchor, settings_.storage);
        exposed_ = exposedCells(placed.resolution, moved);
    }

    // Covers nothing any more, as at first; asks for no memory.
    void forget() {
        placed_ = {};
        std::fill(level_.table.begin(), level_.table.end(), kClvNoSlot);
        level_.slots.clear();
        level_.splits.clear();
        sketch_.inside.clear();
        sketch_.lower.clear();
        slotPool_.clear();
        splitPool_.clear();
    }

    // Calls visit(cell) for every cell that the last move exposed, always in the same order.
    template <class Visit>
    void forExposedCells(Visit&& visit) const {
        for (const CellBox& box : exposed_) {
            for (std::size_t i = 0; i < cellsInBox(box); ++i) visit(cellOfBox(box, i));
        }
    }

    // Analyses the exposed cells.
    void fill(const SceneProbe& probe, const ParallelFor& parallelFor) {
        forExposedCells([&](const ivec3& cell) { release(clvCellIndex(level_.volume, cell)); });
        for (const CellBox& box : exposed_) {
            forBlocks(box, [&](const ClvVolume& block, const CellBox& part) {
                survey_.run(block, part, settings_.linesPerCell, {}, probe, parallelFor);
                survey_.forEach([&](const ivec3& cell, auto&&... found) { store(clvCellIndex(block, cell), found...); });
            });
        }
        // Neighbours of exposed cells see them for the first time.
        auto look = [&](uint slot) { seeLowerNeighbours(level_, sketch_, slot, probe); };
        forSlotsAround(look, parallelFor);
        auto mirror = [&](uint slot) { mirrorHigherNeighbours(level_, sketch_, slot); };
        forSlotsAround(mirror, parallelFor);
    }

private:
    static constexpr std::size_t kCellBytes = sizeof(uint) + sizeof(std::uint8_t);
    static constexpr std::size_t kSlotBytes = sizeof(ClvSlot) + sizeof(vec3) + sizeof(uvec4);

    // A cell has a split at least for every slot beyond its first.
    static std::size_t splitsOf(const MovingLevelSettings& settings) {
        return slotsOf(settings) - std::min(slotsOf(settings), cellsOf(settings));
    }

    // Cuts a box where storage wraps around: calls visit(block, part) for the pieces, in the coordinates of the block that holds them.
    // Blocks tile the world, each as large as the level and stored without scroll, so their lines through the scene stay the same.
    template <class Visit>
    void forBlocks(const CellBox& box, Visit&& visit) const {
        const ivec3 size = placed_.resolution, scroll = level_.volume.scroll;
        for (int i = 0; i < 8; ++i) {
            const ivec3 block = ivec3(i & 1, i >> 1 & 1, i >> 2) * size;
            const CellBox part{max(box.lo + scroll - block, ivec3(0)), min(box.hi + scroll - block, size)};
            if (cellsInBox(part) == 0) continue;
            PlacedCascade placed = placed_;
            placed.lowest += LatticeCell(block - scroll);
            visit(volumeFromCascade(placed, settings_.anchor, settings_.storage), part);
        }
    }

    uint splitsBelow(uint entry) const {
        if (!(entry & kClvSplitBit)) return 0;
        const ClvSplit& split = level_.splits[entry & ~kClvSplitBit];
        return 1 + splitsBelow(split.front) + splitsBelow(split.back);
    }

    void release(uint cell) {
        uint& entry = level_.table[cell];
        if (entry == kClvNoSlot) return;
        const CellSlots slots = slotsOfCell(level_, entry);
        slotPool_.giveBack(slots.first, slots.count);
        if (entry & kClvSplitBit) splitPool_.giveBack(entry & ~kClvSplitBit, splitsBelow(entry));
        entry = kClvNoSlot;
    }

    void store(uint cell, bool cut, std::span<const OpenRegion> regions, std::span<const RegionSplit> splits) {
        const uint slot = slotPool_.take(uint(regions.size()));
        const uint split = splits.empty() ? 0 : splitPool_.take(uint(splits.size()));
        level_.slots.resize(slotPool_.size());
        level_.splits.resize(splitPool_.size());
        sketch_.resizeSlots(slotPool_.size());
        storeCell(level_, sketch_, cell, cut, regions, splits, slot, split);
    }

    // Calls body(slot) for the slots of exposed cells and of their neighbours; for some of them twice.
    template <class Body>
    void forSlotsAround(Body& body, const ParallelFor& parallelFor) {
        for (const CellBox& box : exposed_) {
            if (cellsInBox(box) == 0) continue;
            const CellBox around{max(box.lo - ivec3(1), ivec3(0)), min(box.hi + ivec3(1), level_.volume.resolution)};
            const std::size_t cells = cellsInBox(around), kPiece = 256;
            auto visitPiece = [&](std::size_t piece) {
                for (std::size_t i = piece * kPiece; i < std::min(cells, (piece + 1) * kPiece); ++i) {
                    const uint entry = level_.table[clvCellIndex(level_.volume, cellOfBox(around, i))];
                    if (entry == kClvNoSlot) continue;
                    const CellSlots slots = slotsOfCell(level_, entry);
                    for (uint s = 0; s < slots.count; ++s) body(slots.first + s);
                }
            };
            parallelFor((cells + kPiece - 1) / kPiece, std::ref(visitPiece));
        }
    }

    MovingLevelSettings settings_;
    PlacedCascade placed_;
    Level level_;
    LevelSketch sketch_;
    BlockPool slotPool_{kClvMostSlots};
    BlockPool splitPool_{(1u << kClvMostSplits) - 1u};
    std::array<CellBox, 3> exposed_{};
    BoxSurvey survey_;
};

}  // namespace clv
#endif
