// Lines through a level along its three axes, and where they cross the scene: what the open regions of cells are found from.
#ifndef CLV_CPU_LINE_GRID_H
#define CLV_CPU_LINE_GRID_H
#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include "../data/light_volume.h"
#include "../plan/cell_box.h"
#include "parallel.h"
#include "scene_probe.h"

namespace clv {

// perCell^2 lines a cell along each axis. The lines of the three axes meet in a lattice of perCell^3 points a cell.
class LineGrid {
public:
    // Only lines that pass a needed cell are traced; `needed` holds a flag for each cell of the box, x fastest, or is empty (all).
    // May be called again for another box: memory is kept.
    void trace(const ClvVolume& volume, const CellBox& box, int perCell, const std::vector<std::uint8_t>& needed,
               const SceneProbe& probe, const ParallelFor& parallelFor) {
        volume_ = volume;
        box_ = box;
        perCell_ = perCell;
        solids_ = probe.solids;
        const ivec3 size = box.hi - box.lo;
        for (int axis = 0; axis < 3; ++axis) {
            const int b = (axis + 1) % 3, c = (axis + 2) % 3;
            columns_.assign(std::size_t(size[b]) * size[c], needed.empty() ? 1 : 0);
            for (std::size_t i = 0; i < needed.size(); ++i) {
                if (!needed[i]) continue;
                const int cell[3] = {int(i) % size.x, int(i) / size.x % size.y, int(i) / (size.x * size.y)};
                columns_[std::size_t(cell[b]) + std::size_t(size[b]) * cell[c]] = 1;
            }
            const std::size_t rows = std::size_t(size[c]) * perCell;
            if (rows_[axis].size() < rows) rows_[axis].resize(rows);
            auto traceOne = [&](std::size_t row) { traceRow(axis, int(row), probe); };
            parallelFor(rows, std::ref(traceOne));
        }
    }

    const ClvVolume& volume() const { return volume_; }
    int perCell() const { return perCell_; }
    bool solids() const { return solids_; }

    // Offset of a lattice coordinate inside a cell, in cells. The small shifts keep lines off surfaces that are aligned with cells.
    float latticeOffset(int axis, int i) const {
        const float shift[3] = {0.0132f, -0.0171f, 0.0093f};
        return (float(i) + 0.5f + shift[axis]) / float(perCell_);
    }

    // All crossings of the line along `axis` with lattice coordinates (i, j) in cell column (cell[b], cell[c]), b and c the next
    // two axes in turn. Distances are from the volume's lower face, m: what is found in a cell does not depend on the box.
    std::span<const LineHit> line(int axis, const ivec3& cell, int i, int j) const {
        const int b = (axis + 1) % 3, c = (axis + 2) % 3;
        const Row& row = rows_[axis][std::size_t(cell[c] - box_.lo[c]) * perCell_ + j];
        const std::size_t k = std::size_t(cell[b] - box_.lo[b]) * perCell_ + i;
        return {row.hits.data() + row.begin[k], row.begin[k + 1] - row.begin[k]};
    }

    // Where a cell begins along `axis`, in the distances of line().
    float cellBegin(int axis, const ivec3& cell) const { return float(cell[axis]) * volume_.cellSize; }

private:
    struct Row {
        std::vector<std::uint32_t> begin;  // a line each, and the end
        std::vector<LineHit> hits;
        std::vector<LineHit> ofLine;       // while it is traced
    };

    void traceRow(int axis, int rowIndex, const SceneProbe& probe) {
        const int b = (axis + 1) % 3, c = (axis + 2) % 3;
        const int columnsB = box_.hi[b] - box_.lo[b];
        const float h = volume_.cellSize;
        // Lines begin the volume's length before it and end as far behind it, so that a solid which it cuts shows both of its faces.
        const float length = float(volume_.resolution[axis]) * h;
        Row& row = rows_[axis][rowIndex];
        row.begin.assign(std::size_t(columnsB) * perCell_ + 1, 0);
        row.hits.clear();
        vec3 direction(0.0f);
        direction[axis] = 1.0f;
        for (int k = 0; k < columnsB * perCell_; ++k) {
            row.begin[k] = std::uint32_t(row.hits.size());
            if (!columns_[std::size_t(k / perCell_) + std::size_t(columnsB) * (rowIndex / perCell_)]) continue;
            vec3 start = volume_.origin;
            start[b] += h * (float(box_.lo[b] + k / perCell_) + latticeOffset(b, k % perCell_));
            start[c] += h * (float(box_.lo[c] + rowIndex / perCell_) + latticeOffset(c, rowIndex % perCell_));
            start[axis] -= length;
            probe.lineHits(start, direction, 3.0f * length, row.ofLine);
            for (LineHit hit : row.ofLine) {
                hit.distance -= length;
                row.hits.push_back(hit);
            }
        }
        row.begin.back() = std::uint32_t(row.hits.size());
    }

    ClvVolume volume_{};
    CellBox box_{};
    int perCell_ = 0;
    bool solids_ = true;
    std::vector<std::uint8_t> columns_;
    std::vector<Row> rows_[3];
};

}  // namespace clv
#endif
