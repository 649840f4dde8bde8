// For tests of a device: where each ray's walk enters and leaves the grid, how many cells it crosses, and its faults: cells that are not the
// next one forwards, pieces that do not begin where the one before ended.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "clv/data/frame.h"
#include "clv/stages/inject.h"

layout(local_size_x = CLV_GROUP_SIZE) in;
layout(std140, binding = CLV_BIND_FRAME) uniform FrameBlock { ClvFrame frame; };
layout(std140, binding = CLV_BIND_LEVEL) uniform LevelBlock { ClvLevelFrame level; };
layout(binding = CLV_BIND_RAYS) uniform samplerBuffer rays;
layout(std430, binding = CLV_BIND_IRRADIANCE) writeonly buffer Checks { vec4 checks[]; };

void main() {
    uint i = clvItem(gl_GlobalInvocationID);
    if (i >= frame.rayCount) return;
    int row = int(3u * i);
    ClvRay ray = clvRayFromRows(texelFetch(rays, row), texelFetch(rays, row + 1), texelFetch(rays, row + 2));
    ClvWalk walk = clvWalkBegin(level.volume, ray);
    int most = level.volume.resolution.x + level.volume.resolution.y + level.volume.resolution.z;
    int cells = 0;
    uint faults = 0u;
    float begin = walk.running == 1 ? walk.t : 0.0f;
    float end = begin;
    ivec3 last = walk.cell;
    while (walk.running == 1 && cells <= most) {
        ClvCrossing crossing = clvWalkStep(walk, ray.direction);
        ivec3 moved = crossing.cell - last;
        vec3 forwards = vec3(moved) * ray.direction;
        int away = abs(moved.x) + abs(moved.y) + abs(moved.z);
        bool next = cells == 0 ? away == 0 : away == 1 && forwards.x + forwards.y + forwards.z > 0.0f;
        bool joined = crossing.tBegin == end && crossing.tEnd >= crossing.tBegin;
        if (!next || !joined || clvCellInside(level.volume, crossing.cell) == 0) ++faults;
        last = crossing.cell;
        end = crossing.tEnd;
        ++cells;
    }
    if (walk.running == 1) ++faults;
    checks[i] = vec4(begin, end, float(cells), float(faults));
}
