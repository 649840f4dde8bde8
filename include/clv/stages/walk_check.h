// What the walk of one ray adds up to: for tests of a device, and of the walk itself.
#ifndef CLV_STAGES_WALK_CHECK_H
#define CLV_STAGES_WALK_CHECK_H
#include "inject.h"
CLV_NAMESPACE_BEGIN

// Pieces of a walk without faults begin where the one before ended, so that together they are as long as end - begin.
struct ClvWalkCheck {
    float begin;      // in cells along the ray: where the first crossing begins,
    float end;        // and where the last one ends; both 0 where there is none
    int cells;        // crossings
    int faults;       // crossings outside of the grid, not of the next cell forwards, or not joined to the one before; an endless walk
    ivec3 farCell;    // the cell from whose box a piece's begin or end lies farthest, as floats tell: to some tenths of a last place,
    float farAt;      // and where along the ray this is, in cells; 0 where there is no crossing
};

// How far a place along the ray lies outside of a cell, in cells; below 0 inside.
CLV_FN float clvOutsideOfCell(ClvWalk walk, vec3 direction, ivec3 cell, float t) {
    vec3 above = walk.origin - vec3(float(cell.x), float(cell.y), float(cell.z)) + direction * t;
    vec3 outside = max(-above, above - vec3(1.0f, 1.0f, 1.0f));
    return max(max(outside.x, outside.y), outside.z);
}

CLV_FN ClvWalkCheck clvCheckWalk(ClvVolume volume, ClvRay ray) {
    ClvWalk walk = clvWalkBegin(volume, ray);
    ClvWalkCheck check;
    check.begin = walk.running == 1 ? walk.t : 0.0f;
    check.end = check.begin;
    check.cells = 0;
    check.faults = 0;
    check.farCell = walk.cell;
    check.farAt = check.begin;
    float farthest = -1.0f;
    int most = volume.resolution.x + volume.resolution.y + volume.resolution.z;
    ivec3 last = walk.cell;
    while (walk.running == 1 && check.cells <= most) {
        ClvCrossing crossing = clvWalkStep(walk, ray.direction);
        ivec3 moved = crossing.cell - last;
        int away = abs(moved.x) + abs(moved.y) + abs(moved.z);
        float forwards = float(moved.x) * ray.direction.x + float(moved.y) * ray.direction.y + float(moved.z) * ray.direction.z;
        bool next = check.cells == 0 ? away == 0 : away == 1 && forwards > 0.0f;
        bool joined = crossing.tBegin == check.end && crossing.tEnd >= crossing.tBegin;
        if (!next || !joined || clvCellInside(volume, crossing.cell) == 0) check.faults += 1;
        float begin = clvOutsideOfCell(walk, ray.direction, crossing.cell, crossing.tBegin);
        float end = clvOutsideOfCell(walk, ray.direction, crossing.cell, crossing.tEnd);
        if (max(begin, end) > farthest) {
            farthest = max(begin, end);
            check.farCell = crossing.cell;
            check.farAt = begin > end ? crossing.tBegin : crossing.tEnd;
        }
        last = crossing.cell;
        check.end = crossing.tEnd;
        check.cells += 1;
    }
    if (walk.running == 1) check.faults += 1;
    return check;
}

CLV_NAMESPACE_END
#endif
