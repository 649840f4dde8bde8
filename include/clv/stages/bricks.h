// Bricks of 2^3 cells: a coarser grid over a level, in which the rays that cross each brick are listed.
#ifndef CLV_STAGES_BRICKS_H
#define CLV_STAGES_BRICKS_H
#include "../data/light_volume.h"
CLV_NAMESPACE_BEGIN

CLV_CONST uint kClvBrickLanes = 8u;  // slots that are filled together

CLV_FN ivec3 clvBrickCounts(ClvVolume volume) {
    return ivec3((volume.resolution.x + 1) / 2, (volume.resolution.y + 1) / 2, (volume.resolution.z + 1) / 2);
}

// The bricks as a grid that rays may walk through.
CLV_FN ClvVolume clvBrickVolume(ClvVolume volume) {
    ClvVolume bricks = volume;
    bricks.cellSize = 2.0f * volume.cellSize;
    bricks.resolution = clvBrickCounts(volume);
    bricks.scroll = ivec3(0, 0, 0);
    return bricks;
}

CLV_FN uint clvBrickOfCell(ClvVolume volume, ivec3 cell) {
    return clvCellIndex(clvBrickVolume(volume), ivec3(cell.x / 2, cell.y / 2, cell.z / 2));
}

// Words of a mask with a bit a brick.
CLV_FN uint clvBrickMaskWords(ClvVolume volume) {
    ivec3 bricks = clvBrickCounts(volume);
    return (uint(bricks.x * bricks.y * bricks.z) + 31u) / 32u;
}

CLV_NAMESPACE_END
#endif
