// What a rasteriser draws of a line by the diamond-exit rule, on the CPU.
#pragma once
#include <algorithm>
#include <cmath>

#include "clv/stages/slices.h"

namespace clv {

// Cells that the line of a piece draws. On a step that passes between two cells to less than `kTie`, it draws either of them.
inline constexpr double kTie = 1.0 / 64.0;
template <class Sure, class Either>
void forCellsOfLine(const ClvSlicePiece& piece, Sure&& sure, Either&& either) {
    const ivec2 back = piece.begin - piece.end;
    const int steps = std::max(std::abs(back.x), std::abs(back.y));
    // The first point of a line is drawn, the last one is not; see clvLineVertex.
    for (int k = 0; k < (piece.isFirst == 1 ? steps : steps + 1); ++k) {
        const double share = steps > 0 ? double(k) / steps : 0.0;
        const double x = piece.end.x + share * back.x, y = piece.end.y + share * back.y;
        const ivec2 cell(int(std::floor(x + 0.5)), int(std::floor(y + 0.5)));
        const double tieX = std::abs(x - std::floor(x) - 0.5), tieY = std::abs(y - std::floor(y) - 0.5);
        if (std::min(tieX, tieY) < kTie) {
            either(ivec2(int(std::floor(x)), int(std::floor(y))));
            either(ivec2(int(std::ceil(x)), int(std::ceil(y))));
        } else {
            sure(cell);
        }
    }
}

}  // namespace clv
