// Writes each ray into the lists of the slices that it crosses; a list has room for every ray.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "clv/data/frame.h"
#include "clv/stages/slices.h"

layout(local_size_x = CLV_GROUP_SIZE) in;
layout(std140, binding = CLV_BIND_FRAME) uniform FrameBlock { ClvFrame frame; };
layout(std140, binding = CLV_BIND_LEVEL) uniform LevelBlock { ClvLevelFrame level; };
layout(binding = CLV_BIND_RAYS) uniform samplerBuffer rays;
layout(std430, binding = CLV_BIND_SLICE_DRAWS) buffer Draws { uint draws[]; };
layout(std430, binding = CLV_BIND_SLICE_RAYS) writeonly buffer SliceRays { uint sliceRays[]; };

void main() {
    uint i = clvItem(gl_GlobalInvocationID);
    if (i >= frame.rayCount) return;
    uint perHalf = frame.rayCount / frame.halves;
    uint firstLayer = i / perHalf * uint(level.volume.resolution.z);
    int row = int(3u * i);
    ClvRay ray = clvRayFromRows(texelFetch(rays, row), texelFetch(rays, row + 1), texelFetch(rays, row + 2));
    ClvSlices slices = clvSlicesOfRay(level.volume, ray);
    for (int k = 0; k < slices.count; ++k) {
        int slice = slices.first + k * slices.step;
        if (!clvPieceIsDrawn(clvSlicePiece(level.volume, ray, slice))) continue;
        uint layer = firstLayer + uint(slice);
        sliceRays[layer * perHalf + atomicAdd(draws[4u * layer], 2u) / 2u] = i;
    }
}
