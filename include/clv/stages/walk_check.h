// What the walk of one ray adds up to: for tests of a device, and of the walk itself.
#ifndef CLV_STAGES_WALK_CHECK_H
#define CLV_STAGES_WALK_CHECK_H
#include "inject.h"
CLV_NAMESPACE_BEGIN

// Pieces of a walk without faults begin where the one before ended, so that together they are as long as end - begin.
struct ClvWalkCheck {
    float begin;   // in cells along the ray: where the first crossing begins,
    float end;     // and where the last one ends; both 0 where there is none
    int cells;     // crossings
    int faults;    // crossings that are outside of the grid, not of the next cell forwards, or not joined to the one before, and an endless walk
};

CLV_FN ClvWalkCheck clvCheckWalk(ClvVolume volume, ClvRay ray) {
    ClvWalk walk = clvWalkBegin(volume, ray);
    ClvWalkCheck check;
    check.begin = walk.running == 1 ? walk.t : 0.0f;
    check.end = check.begin;
    check.cells = 0;
    check.faults = 0;
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
        last = crossing.cell;
        check.end = crossing.tEnd;
        check.cells += 1;
    }
    if (walk.running == 1) check.faults += 1;
    return check;
}

CLV_NAMESPACE_END
#endif
