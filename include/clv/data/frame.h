// What the passes of a frame on the GPU know beside their buffers: two blocks of constants, written by the host before each frame.
#ifndef CLV_DATA_FRAME_H
#define CLV_DATA_FRAME_H
#include "gpu_bindings.h"
#include "light_volume.h"
CLV_NAMESPACE_BEGIN

struct ClvFrame {        // 128 bytes; of the whole frame
    vec3 boundsLo;       // m, relative to the anchor: what the maps of directional lights cover
    uint rayCount;       // >= 1, a multiple of `halves`
    vec3 boundsHi;
    uint halves;         // 1 or 2: the rays are cut into as many estimates, one after the other
    uint firstIndex;     // of this frame's first ray in the sequence that all halves share
    uint halfStep;       // from a half's first ray to that of the next, in that sequence
    uint seed;           // of the rays
    uint rsmPass;        // which of the well-spread points of its texels this frame's map samples
    uint rsmSeed;        // a light adds its number
    uint rsmSide;        // texels in a row: along a side of a light's map
    uint texelRows;      // of all maps, stacked: light k owns the rows [k, k + 1) * rsmSide
    uint receiverCount;
    vec3 axisX;          // of the axes along which cells keep directions: orthogonal, of unit length
    float originOffset;  // m, >= 0: rays start this far above their surface
    vec3 axisY;
    uint triangleCount;  // in the tree
    vec3 axisZ;
    uint faceCount;      // of maps that are drawn
    uint faceSide;       // texels along a side of a face
    uint pad0;
    uint pad1;
    uint pad2;
};

struct ClvLevelFrame {   // 96 bytes; of one level of the light volume
    ClvVolume volume;
    uint slotCount;
    float scale;         // > 0: turns a half's sum of deposits into its estimate, 1 / rays of the half
    float weight;        // (0, 1]: of this frame in the history
    float fixedScale;    // > 0, 1/(W m): units of a deposit where they are added as integers
    uvec4 groupEnds;     // where the groups of eight slots end whose cells have at most 0, 1, 2 and 3 splits on the way to a slot
    uint groupCount;     // of all groups
    uint brickCount;     // bricks of 2^3 cells
    uint pad0;
    uint pad1;
};

// A direction as cells keep it. turned: 0 where they keep it along the axes of the grid; a constant.
CLV_FN vec3 clvKeptDirection(ClvFrame frame, uint turned, vec3 direction) {
    return turned == 0u ? direction : vec3(dot(frame.axisX, direction), dot(frame.axisY, direction), dot(frame.axisZ, direction));
}

// Index of a thread's item: work groups lie in rows of CLV_GROUP_ROW, since devices take only 65535 along an axis.
CLV_FN uint clvItem(uvec3 thread) { return thread.x + thread.y * uint(CLV_GROUP_ROW * CLV_GROUP_SIZE); }

CLV_NAMESPACE_END
#endif
