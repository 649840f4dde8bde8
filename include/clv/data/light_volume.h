// A level of a light volume: a regular grid of cubic cells, and what lies in each cell.
//
// A cell owns *slots*. A slot is one open region with one record of deposits. Most cells have one slot, which is the whole cell;
// a cell that a thin wall or a drape cuts has two, so that the light of the two sides never mixes; a cell that nothing reads,
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

struct ClvSplit {      // 32 bytes: the plane that parts a cell's two slots
    vec3 normal;       // unit length
    float offset;      // m: dot(normal, position) - offset > 0 on the front side
    uint frontSlot;
    uint backSlot;
    uint pad0;
    uint pad1;
};

struct ClvSlot {       // 32 bytes
    vec3 centroid;     // m, relative to the anchor: centroid of the open region
    float openVolume;  // m^3, > 0
    uint visibleFront; // bit k: the first slot (the front one of a split) of neighbour k is in sight; k = (x+1) + 3 (y+1) + 9 (z+1)
    uint visibleBack;  // the same for the back slot of a neighbour that is split
    uint cell;         // index into the cell table
    uint pad0;
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

CLV_NAMESPACE_END
#endif
