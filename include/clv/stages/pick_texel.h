// Picks a texel of the stacked reflective shadow maps in proportion to its flux: first a row, then a texel in it.
//
// Running sums lie in one array: for each row of `side` texels side + 1 sums from 0 to 1, then rows + 1 sums over the rows. A row
// without flux has 1 throughout. A shader defines, before it includes this: float clvReadTexelSum(uint index).
#ifndef CLV_STAGES_PICK_TEXEL_H
#define CLV_STAGES_PICK_TEXEL_H
#include "../lang.h"
CLV_NAMESPACE_BEGIN

// The place in a sequence of `count` points of the one that thread `i` takes: a permutation. In Sobol' points whose indices are
// multiples of a power of two apart, the first two coordinates fall into the same small rectangle: neighbouring threads pick texels
// next to each other, and their rays begin on the same way through a scene.
CLV_CONST uint kClvNeighbours = 64u;
CLV_FN uint clvNeighbourIndex(uint i, uint count) {
    uint apart = count / kClvNeighbours;
    return i < apart * kClvNeighbours ? (i % kClvNeighbours) * apart + i / kClvNeighbours : i;
}

struct ClvTexelPick {
    uint texel;         // row * side + column
    float probability;  // [0, 1]; 0: there is no flux at all
};

// The last of `count` items whose running sum, from index `first` on, does not exceed u in [0, 1).
CLV_READER_FN uint clvPickItem(CLV_READER uint first, uint count, float u) {
    uint lo = 0u;
    uint hi = count;
    while (hi - lo > 1u) {
        uint middle = (lo + hi) / 2u;
        if (CLV_READ clvReadTexelSum(first + middle) <= u) {
            lo = middle;
        } else {
            hi = middle;
        }
    }
    return lo;
}

// u: in [0, 1)^2.
CLV_READER_FN ClvTexelPick clvPickTexel(CLV_READER uint side, uint rows, vec2 u) {
    uint overRows = rows * (side + 1u);
    uint row = clvPickItem(CLV_PASS_READER overRows, rows, u.x);
    uint inRow = row * (side + 1u);
    uint column = clvPickItem(CLV_PASS_READER inRow, side, u.y);
    ClvTexelPick pick;
    pick.texel = row * side + column;
    pick.probability = (CLV_READ clvReadTexelSum(overRows + row + 1u) - CLV_READ clvReadTexelSum(overRows + row)) *
                       (CLV_READ clvReadTexelSum(inRow + column + 1u) - CLV_READ clvReadTexelSum(inRow + column));
    return pick;
}

CLV_NAMESPACE_END
#endif
