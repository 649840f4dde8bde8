// Nested light volumes with growing cells: which of them lights a position.
#ifndef CLV_DATA_CASCADES_H
#define CLV_DATA_CASCADES_H
#include "light_volume.h"
CLV_NAMESPACE_BEGIN

CLV_CONST uint kClvMaxCascades = 8u;

struct ClvCascades {
    ClvVolume volumes[kClvMaxCascades];  // finest first
    uint count;                          // [1, kClvMaxCascades]
    float marginCells;                   // a position nearer to a volume's side than this is left to the next one, cells
    float blendCells;                    // width of the zone inside the margin where two volumes mix, cells
    uint pad0;
};

// The remainder of x / n that is in [0, n), for negative x too: toroidal addressing.
CLV_FN int clvWrap(int x, int n) {
    int r = x % n;
    return r < 0 ? r + n : r;
}

// Distance to the volume's nearest side, cells; negative outside.
CLV_FN float clvCellsToEdge(CLV_IN(ClvVolume) volume, vec3 position) {
    vec3 p = (position - volume.origin) / volume.cellSize;
    float x = min(p.x, float(volume.resolution.x) - p.x);
    float y = min(p.y, float(volume.resolution.y) - p.y);
    float z = min(p.z, float(volume.resolution.z) - p.z);
    return min(x, min(y, z));
}

// The finest cascade that holds the position with the margin, else the last one.
CLV_FN uint clvCascadeFromPosition(CLV_IN(ClvCascades) cascades, vec3 position) {
    uint last = cascades.count - 1u;
    for (uint i = 0u; i < last; ++i) {
        if (clvCellsToEdge(cascades.volumes[i], position) >= cascades.marginCells) return i;
    }
    return last;
}

// Weight of `cascade` at a position that clvCascadeFromPosition gave to it, [0, 1]; the rest belongs to the next coarser one.
// Continuous: 0 where the margin begins, 1 from blendCells further inside.
CLV_FN float clvCascadeWeight(CLV_IN(ClvCascades) cascades, uint cascade, vec3 position) {
    if (cascade + 1u >= cascades.count) return 1.0f;
    float inside = clvCellsToEdge(cascades.volumes[cascade], position) - cascades.marginCells;
    return clamp(inside / max(cascades.blendCells, 1.0e-6f), 0.0f, 1.0f);
}

// The nearest position inside the volume: light beyond the last cascade is that of its edge.
CLV_FN vec3 clvClampToVolume(CLV_IN(ClvVolume) volume, vec3 position) {
    vec3 size = vec3(float(volume.resolution.x), float(volume.resolution.y), float(volume.resolution.z)) * volume.cellSize;
    return clamp(position, volume.origin, volume.origin + size);
}

CLV_NAMESPACE_END
#endif
