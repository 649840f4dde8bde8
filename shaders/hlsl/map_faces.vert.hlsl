// Draws the scene as a light sees it through one face of its map: three vertices a triangle.
#include "clv/data/frame.h"
#include "clv/stages/map_face.h"
#include "triangles.hlsli"

[[vk::push_constant]] cbuffer Draw { uint layer; };
[[vk::binding(CLV_BIND_FRAME)]] cbuffer FrameBlock { ClvFrame frame; };
[[vk::binding(CLV_BIND_MAP_FACES)]] StructuredBuffer<ClvMapFace> faces;

struct Vertex {
    float4 position : SV_Position;
    [[vk::location(0)]] nointerpolation uint seen : TRIANGLE;
};

Vertex main(uint vertexIndex : SV_VertexID) {
    // The tree may have left some triangles of the scene out: in their place, the last one is drawn again.
    uint index = min(vertexIndex / 3u, frame.triangleCount - 1u);
    Vertex vertex;
    vertex.position = clvFacePosition(faces[layer], clvCornerOfTriangle(index, vertexIndex % 3u));
    vertex.seen = index + 1u;
    return vertex;
}
