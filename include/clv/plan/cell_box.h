// A box of cells, in logical cell coordinates.
#ifndef CLV_PLAN_CELL_BOX_H
#define CLV_PLAN_CELL_BOX_H
#include <cstddef>

#include "../lang.h"

namespace clv {

struct CellBox {
    ivec3 lo{0};
    ivec3 hi{0};  // excluded
};

inline std::size_t cellsInBox(const CellBox& box) {
    const ivec3 size = max(box.hi - box.lo, ivec3(0));
    return std::size_t(size.x) * size.y * size.z;
}

// Cell i of a box, x fastest.
inline ivec3 cellOfBox(const CellBox& box, std::size_t i) {
    const ivec3 size = box.hi - box.lo;
    return box.lo + ivec3(int(i % size.x), int(i / size.x % size.y), int(i / (std::size_t(size.x) * size.y)));
}

}  // namespace clv
#endif
