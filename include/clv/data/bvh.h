// A tree of boxes over triangles with four children a node, as texel buffers hold it: rows of four floats, or four integers.
//
// Node k has kClvBvhBoxRows rows of boxes, a component a child: lowest x, highest x, lowest y, highest y, lowest z, highest z;
// and one row of children. Node 0 is the root. A child is another node, or with kClvBvhLeafBit set a run of triangles. One that does
// not exist is a leaf of no triangles, in a box that is a far point: no ray meets it.
#ifndef CLV_DATA_BVH_H
#define CLV_DATA_BVH_H
#include "../math/constants.h"
CLV_NAMESPACE_BEGIN

CLV_CONST uint kClvBvhBoxRows = 6u;
CLV_CONST uint kClvBvhLeafBit = 0x80000000u;
CLV_CONST uint kClvBvhCountBits = 4u;          // of a leaf: the lowest bits are its number of triangles, those above it the first one
CLV_CONST uint kClvBvhMostTriangles = 15u;     // a leaf
CLV_CONST uint kClvBvhStack = 64u;             // entries that a walk may need; trees are built no deeper
CLV_CONST uint kClvNoChild = 0x80000000u;      // a leaf of no triangles

// Rows of a triangle: first corner, the edges from it to the second and the third; in the w of the first two rows the lower and the
// upper 16 bits of its index in the scene, as numbers, since texel buffers may not keep the bits of every float.
CLV_CONST uint kClvTriangleRows = 3u;

// Index of a triangle in the scene, from the w of its first two rows.
CLV_FN uint clvSceneIndexOf(float lower, float upper) { return uint(lower) | (uint(upper) << 16); }

CLV_FN uint clvBvhLeaf(uint firstTriangle, uint count) { return kClvBvhLeafBit | (firstTriangle << kClvBvhCountBits) | count; }
CLV_FN uint clvBvhLeafFirst(uint child) { return (child & ~kClvBvhLeafBit) >> kClvBvhCountBits; }
CLV_FN uint clvBvhLeafCount(uint child) { return child & ((1u << kClvBvhCountBits) - 1u); }
// A leaf of one triangle or more without its first; kClvNoChild when that was all.
CLV_FN uint clvBvhLeafRest(uint child) {
    uint count = clvBvhLeafCount(child);
    return count > 1u ? clvBvhLeaf(clvBvhLeafFirst(child) + 1u, count - 1u) : kClvNoChild;
}

CLV_NAMESPACE_END
#endif
