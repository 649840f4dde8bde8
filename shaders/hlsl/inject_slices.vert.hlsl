// A line for each ray that crosses the slice: two vertices a ray of its list.
#include "clv/data/frame.h"
#include "clv/stages/slices.h"
[[vk::constant_id(CLV_SPEC_CHANNELS)]] const uint channels = 3u;
[[vk::constant_id(CLV_SPEC_TURNED)]] const uint turned = 0u;

[[vk::push_constant]] cbuffer Draw { uint layer; };
[[vk::binding(CLV_BIND_FRAME)]] cbuffer FrameBlock { ClvFrame frame; };
[[vk::binding(CLV_BIND_LEVEL)]] cbuffer LevelBlock { ClvLevelFrame level; };
[[vk::binding(CLV_BIND_RAYS)]] Buffer<float4> rays;
[[vk::binding(CLV_BIND_SLICE_RAYS)]] StructuredBuffer<uint> sliceRays;

struct Vertex {
    float4 position : SV_Position;
    [[vk::location(0)]] nointerpolation float4 keptDirection : DIRECTION;
    [[vk::location(1)]] nointerpolation float4 flux : FLUX;
};

Vertex main(uint vertexIndex : SV_VertexID) {
    uint perHalf = frame.rayCount / frame.halves;
    int row = int(3u * sliceRays[layer * perHalf + vertexIndex / 2u]);
    ClvRay ray = clvRayFromRows(rays.Load(row), rays.Load(row + 1), rays.Load(row + 2));
    ClvSlicePiece piece = clvSlicePiece(level.volume, ray, int(layer % uint(level.volume.resolution.z)));
    Vertex vertex;
    vertex.position = clvSlicePosition(level.volume, clvLineVertex(piece, vertexIndex % 2u));
    vertex.keptDirection = float4(clvKeptDirection(frame, turned, ray.direction), 0.0);
    vertex.flux = float4(clvChannelFlux(channels, ray, clvMostFlux(kClvInjectThesis, level.volume.cellSize)), ray.dynamicity);
    return vertex;
}
