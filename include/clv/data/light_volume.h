// A level of a light volume: a regular grid of cubic cells, and what lies in each cell.
//
// A cell owns *slots*. A slot is one open region with one record of deposits. Most cells have one slot, which is the whole cell;
// a cell that a thin wall or a drape cuts has one for each side, so that their light never mixes; a cell that nothing reads,
// or that lies inside a solid, has none.
#ifndef CLV_DATA_LIGHT_VOLUME_H
#define CLV_DATA_LIGHT_VOLUME_H
#include "../math/constants.h"
CLV_NAMESPACE_BEGIN

struct ClvVolume {     // 48 bytes
    vec3 origin;       // m, relative to the anchor: the lowest corner
    float cellSize;    // m, > 0
    ivec3 resolution;  // cells an axis, >= 1
    uint storage;      // kClvStorage...
    ivec3 scroll;      // storage coordinate of the lowest cell, [0, resolution): toroidal addressing
    uint pad0;
};

// Entry of the cell table: a slot, a split (with kClvSplitBit set), or kClvNoSlot.
CLV_CONST uint kClvNoSlot = 0xffffffffu;
CLV_CONST uint kClvSplitBit = 0x80000000u;

// Parts a cell by a plane. Each side is a slot, or a further split: a cell in which three rooms meet is a small tree of planes.
struct ClvSplit {      // 32 bytes
    vec4 plane;        // unit normal and offset, m: dot(normal, position) > offset in front
    uint front;        // a slot, or a split with kClvSplitBit set
    uint back;
    uint firstSlot;    // the cell's slots are neighbours in memory; set in the first split of a cell
    uint slotCount;    // [1, kClvMostSlots]
};

CLV_CONST uint kClvMostSlots = 4u;   // a cell
CLV_CONST int kClvMostSplits = 4;    // on the way from a cell to a slot

struct ClvSlot {       // 48 bytes
    vec3 openCentroid; // m, relative to the anchor: centroid of the open region
    float openVolume;  // m^3, > 0
    uvec4 visible;     // bit k of component i: slot i of neighbour k is in sight; k = (x+1) + 3 (y+1) + 9 (z+1)
    uint cell;         // index into the cell table
    uint pad0;
    uint pad1;
    uint pad2;
};

// Cell that holds a position, as coordinates that may lie outside the volume.
CLV_FN ivec3 clvCellFromPosition(ClvVolume volume, vec3 position) {
    vec3 p = floor((position - volume.origin) / volume.cellSize);
    // Clamped, since a float beyond the integers has no defined conversion.
    p = clamp(p, vec3(-1.0e9f, -1.0e9f, -1.0e9f), vec3(1.0e9f, 1.0e9f, 1.0e9f));
    return ivec3(int(p.x), int(p.y), int(p.z));
}

// Centre of a cell, m, relative to the anchor.
CLV_FN vec3 clvCellCenter(ClvVolume volume, ivec3 cell) {
    return volume.origin + volume.cellSize * (vec3(float(cell.x), float(cell.y), float(cell.z)) + vec3(0.5f, 0.5f, 0.5f));
}

CLV_FN int clvCellInside(ClvVolume volume, ivec3 cell) {
    return cell.x >= 0 && cell.y >= 0 && cell.z >= 0 && cell.x < volume.resolution.x && cell.y < volume.resolution.y &&
                   cell.z < volume.resolution.z
               ? 1
               : 0;
}

CLV_FN ivec3 clvClampCell(ClvVolume volume, ivec3 cell) {
    return ivec3(clamp(cell.x, 0, volume.resolution.x - 1), clamp(cell.y, 0, volume.resolution.y - 1),
                 clamp(cell.z, 0, volume.resolution.z - 1));
}

// Index of a cell inside the volume into the cell table: x runs fastest, coordinates wrap around at `scroll`.
CLV_FN uint clvCellIndex(ClvVolume volume, ivec3 cell) {
    int x = cell.x + volume.scroll.x;
    int y = cell.y + volume.scroll.y;
    int z = cell.z + volume.scroll.z;
    x = x >= volume.resolution.x ? x - volume.resolution.x : x;
    y = y >= volume.resolution.y ? y - volume.resolution.y : y;
    z = z >= volume.resolution.z ? z - volume.resolution.z : z;
    return uint(x + volume.resolution.x * (y + volume.resolution.y * z));
}

// The inverse of clvCellIndex.
CLV_FN ivec3 clvCellFromIndex(ClvVolume volume, uint index) {
    int i = int(index);
    int x = i % volume.resolution.x - volume.scroll.x;
    int y = (i / volume.resolution.x) % volume.resolution.y - volume.scroll.y;
    int z = i / (volume.resolution.x * volume.resolution.y) - volume.scroll.z;
    return ivec3(x < 0 ? x + volume.resolution.x : x, y < 0 ? y + volume.resolution.y : y, z < 0 ? z + volume.resolution.z : z);
}

CLV_FN int clvInFrontOfSplit(ClvSplit split, vec3 position) {
    return split.plane.x * position.x + split.plane.y * position.y + split.plane.z * position.z > split.plane.w ? 1 : 0;
}

CLV_NAMESPACE_END
#endif
