// The octahedral map: the sphere of directions on the square [-1, 1]^2 (Praun and Hoppe 2003; Cigolle et al. 2014).
// The centre of the square is +z, its corners are -z.
#ifndef CLV_MATH_OCTAHEDRAL_H
#define CLV_MATH_OCTAHEDRAL_H
#include "../lang.h"
CLV_NAMESPACE_BEGIN

// The sign of x, with 1 for both zeros, so that no point of the square falls out of the map.
CLV_FN float clvSignOrOne(float x) { return x < 0.0f ? -1.0f : 1.0f; }

// Swaps the inner diamond |x| + |y| < 1 and the corners around it; its own inverse on both.
CLV_FN vec2 clvOctahedralFold(vec2 square) {
    return vec2((1.0f - abs(square.y)) * clvSignOrOne(square.x), (1.0f - abs(square.x)) * clvSignOrOne(square.y));
}

// The point of the octahedron |x| + |y| + |z| = 1 that belongs to a point of the square.
CLV_FN vec3 clvOctahedronFromSquare(vec2 square) {
    float z = 1.0f - abs(square.x) - abs(square.y);
    if (z < 0.0f) square = clvOctahedralFold(square);
    return vec3(square.x, square.y, z);
}

CLV_FN vec3 clvDirectionFromOctahedral(vec2 square) { return normalize(clvOctahedronFromSquare(square)); }

// Direction need not be of unit length, but the sum of its components, without their signs, must be a normal float: not 0, nor 1e39.
CLV_FN vec2 clvOctahedralFromDirection(vec3 direction) {
    float scale = 1.0f / (abs(direction.x) + abs(direction.y) + abs(direction.z));
    vec2 square = vec2(direction.x * scale, direction.y * scale);
    if (direction.z < 0.0f) square = clvOctahedralFold(square);
    return square;
}

CLV_NAMESPACE_END
#endif
