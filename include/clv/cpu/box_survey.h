// What a box of cells holds: the open regions of its cells, found piece by piece.
#ifndef CLV_CPU_BOX_SURVEY_H
#define CLV_CPU_BOX_SURVEY_H
#include <functional>
#include <span>

#include "cell_regions.h"

namespace clv {

// The open regions of the cells of a box, found in parallel. Keeps its memory from box to box.
class BoxSurvey {
public:
    // `needed`: a flag a cell of the box, x fastest, or empty for all cells. Others count as having no open space.
    void run(const ClvVolume& volume, const CellBox& box, int linesPerCell, const std::vector<std::uint8_t>& needed,
             const SceneProbe& probe, const ParallelFor& parallelFor) {
        lines_.trace(volume, box, linesPerCell, needed, probe, parallelFor);
        const std::size_t cells = cellsInBox(box), each = (cells + kPieces - 1) / kPieces;
        auto findPiece = [&](std::size_t p) {
            Piece& piece = pieces_[p];
            piece.found.clear();
            piece.regions.clear();
            piece.splits.clear();
            for (std::size_t i = p * each; i < std::min(cells, (p + 1) * each); ++i) {
                if (needed.empty() || needed[i]) piece.add(cellOfBox(box, i), lines_);
            }
        };
        parallelFor(kPieces, std::ref(findPiece));
    }

    // Calls visit(cell, cut, regions, splits) for every cell with open space, x fastest; see CellRegions.
    template <class Visit>
    void forEach(Visit&& visit) const {
        for (const Piece& piece : pieces_) {
            const OpenRegion* region = piece.regions.data();
            const RegionSplit* split = piece.splits.data();
            for (const Found& found : piece.found) {
                visit(found.cell, found.cut, std::span(region, found.regions), std::span(split, found.splits));
                region += found.regions;
                split += found.splits;
            }
        }
    }

private:
    static constexpr std::size_t kPieces = 64;

    struct Found {
        ivec3 cell;
        bool cut;
        std::uint8_t regions, splits;
    };
    struct Piece {
        RegionFinder finder;
        std::vector<Found> found;
        std::vector<OpenRegion> regions;
        std::vector<RegionSplit> splits;

        void add(const ivec3& cell, const LineGrid& lines) {
            const CellRegions& open = finder.find(lines, cell);
            if (open.regions.empty()) return;
            found.push_back({cell, open.cut, std::uint8_t(open.regions.size()), std::uint8_t(open.splits.size())});
            regions.insert(regions.end(), open.regions.begin(), open.regions.end());
            splits.insert(splits.end(), open.splits.begin(), open.splits.end());
        }
    };

    LineGrid lines_;
    std::vector<Piece> pieces_{kPieces};
};

}  // namespace clv
#endif
