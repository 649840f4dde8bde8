// Draws the scene as a light sees it through one face of its map: three vertices a triangle.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "clv/data/frame.h"
#include "clv/stages/map_face.h"
#include "triangles.glsl"

layout(push_constant) uniform Draw { uint layer; };
layout(std140, binding = CLV_BIND_FRAME) uniform FrameBlock { ClvFrame frame; };
layout(std430, binding = CLV_BIND_MAP_FACES) readonly buffer Faces { ClvMapFace faces[]; };
layout(location = 0) flat out uint triangle;

void main() {
    // The tree may have left some triangles of the scene out: in their place, the last one is drawn again.
    uint index = min(uint(gl_VertexIndex) / 3u, frame.triangleCount - 1u);
    gl_Position = clvFacePosition(faces[layer], clvCornerOfTriangle(index, uint(gl_VertexIndex) % 3u));
    triangle = index + 1u;
}
