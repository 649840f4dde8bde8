// A line for each ray that crosses the slice: two vertices a ray of its list.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "clv/data/frame.h"
#include "clv/stages/slices.h"
layout(constant_id = CLV_SPEC_CHANNELS) const uint channels = 3u;
layout(constant_id = CLV_SPEC_TURNED) const uint turned = 0u;

layout(push_constant) uniform Draw { uint layer; };
layout(std140, binding = CLV_BIND_FRAME) uniform FrameBlock { ClvFrame frame; };
layout(std140, binding = CLV_BIND_LEVEL) uniform LevelBlock { ClvLevelFrame level; };
layout(binding = CLV_BIND_RAYS) uniform samplerBuffer rays;
layout(std430, binding = CLV_BIND_SLICE_RAYS) readonly buffer SliceRays { uint sliceRays[]; };
layout(location = 0) flat out vec4 keptDirection;
layout(location = 1) flat out vec4 flux;

void main() {
    uint perHalf = frame.rayCount / frame.halves;
    int row = int(3u * sliceRays[layer * perHalf + uint(gl_VertexIndex) / 2u]);
    ClvRay ray = clvRayFromRows(texelFetch(rays, row), texelFetch(rays, row + 1), texelFetch(rays, row + 2));
    ClvSlicePiece piece = clvSlicePiece(level.volume, ray, int(layer % uint(level.volume.resolution.z)));
    gl_Position = clvSlicePosition(level.volume, clvLineVertex(piece, uint(gl_VertexIndex) % 2u));
    keptDirection = vec4(clvKeptDirection(frame, turned, ray.direction), 0.0);
    flux = vec4(clvChannelFlux(channels, ray, clvMostFlux(kClvInjectThesis, level.volume.cellSize)), ray.dynamicity);
}
