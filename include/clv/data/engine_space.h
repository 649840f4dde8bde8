// From an engine's axes and depth buffer to the library's: right-handed, Y up, -Z ahead, metres.
//
// The functions of this file take positions (after scaling to metres), directions and normals alike. Those between a
// left-handed and a right-handed space mirror: triangles change their winding, angles about an axis change their sign.
#ifndef CLV_DATA_ENGINE_SPACE_H
#define CLV_DATA_ENGINE_SPACE_H
#include "../lang.h"
CLV_NAMESPACE_BEGIN

// Right-handed, Z up, +Y ahead, X right (Blender, most CAD).
CLV_FN vec3 clvFromZUp(vec3 v) { return vec3(v.x, v.z, -v.y); }
CLV_FN vec3 clvToZUp(vec3 v) { return vec3(v.x, -v.z, v.y); }

// Left-handed, Y up, +Z ahead, X right (Unity, Direct3D samples). Its own inverse.
CLV_FN vec3 clvMirrorZ(vec3 v) { return vec3(v.x, v.y, -v.z); }

// Left-handed, Z up, +X ahead, Y right (Unreal, which also counts in centimetres).
CLV_FN vec3 clvFromLeftHandedZUp(vec3 v) { return vec3(v.y, v.z, -v.x); }
CLV_FN vec3 clvToLeftHandedZUp(vec3 v) { return vec3(-v.z, v.x, v.y); }

// Distance ahead of the camera's plane, m, from a depth in [0, 1]; near and far planes in m.
// Reversed depth (1 at the near plane) is the same with near and far exchanged.
CLV_FN float clvAheadFromDepth(float depth, float nearPlane, float farPlane) {
    return nearPlane * farPlane / (farPlane + depth * (nearPlane - farPlane));
}
CLV_FN float clvDepthFromAhead(float ahead, float nearPlane, float farPlane) {
    return farPlane * (ahead - nearPlane) / (ahead * (farPlane - nearPlane));
}

// The same for reversed depth without a far plane: depth 0 is infinitely far, and must not be passed.
CLV_FN float clvAheadFromInfiniteReversedDepth(float depth, float nearPlane) { return nearPlane / depth; }

// A depth in [0, 1] from one in [-1, 1] (OpenGL's default).
CLV_FN float clvDepthFromSignedDepth(float depth) { return 0.5f * depth + 0.5f; }

// Position in view space (the camera at 0 looks along -Z), m. ndc: in [-1, 1], y up; flip y first where the API has it down.
// tanHalfFov: of the horizontal and the vertical field of view, the inverses of the projection's two scales.
CLV_FN vec3 clvViewPositionFromNdc(vec2 ndc, float ahead, vec2 tanHalfFov) {
    return vec3(ndc.x * tanHalfFov.x * ahead, ndc.y * tanHalfFov.y * ahead, -ahead);
}
CLV_FN vec2 clvNdcFromViewPosition(vec3 position, vec2 tanHalfFov) {
    return vec2(position.x / (-position.z * tanHalfFov.x), position.y / (-position.z * tanHalfFov.y));
}

CLV_NAMESPACE_END
#endif
