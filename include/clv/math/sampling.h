// Directions and points from random numbers: each as a triple of sample, probability density and inverse.
#ifndef CLV_MATH_SAMPLING_H
#define CLV_MATH_SAMPLING_H
#include "constants.h"
CLV_NAMESPACE_BEGIN

// Two unit vectors at right angles to `normal` (unit length) and to each other; cross(tangent, bitangent) = normal.
// Duff et al. (2017), "Building an Orthonormal Basis, Revisited": no normal is singular.
CLV_FN void clvBasis(vec3 normal, CLV_OUT(vec3) tangent, CLV_OUT(vec3) bitangent) {
    float side = normal.z >= 0.0f ? 1.0f : -1.0f;
    float a = -1.0f / (side + normal.z);
    float b = normal.x * normal.y * a;
    tangent = vec3(1.0f + side * normal.x * normal.x * a, side * b, -side * normal.x);
    bitangent = vec3(b, side + normal.y * normal.y * a, -normal.y);
}

// Cosine and sine of an angle in [-pi/4, pi/4], rad: Taylor series as far as a float sees them. The languages' own functions differ
// from each other, and do not run in vectors.
CLV_FN vec2 clvCosSinSmall(float angle) {
    float x = angle * angle;
    float c = 1.0f - x * (1.0f / 2.0f) * (1.0f - x * (1.0f / 12.0f) * (1.0f - x * (1.0f / 30.0f) * (1.0f - x * (1.0f / 56.0f))));
    float s = 1.0f - x * (1.0f / 6.0f) * (1.0f - x * (1.0f / 20.0f) * (1.0f - x * (1.0f / 42.0f) * (1.0f - x * (1.0f / 72.0f))));
    return vec2(c, s * angle);
}

// Point of the unit disk, uniform by area (Shirley and Chiu 1997: concentric squares become concentric circles).
CLV_FN vec2 clvDiskFromSquare(vec2 u) {
    float x = 2.0f * u.x - 1.0f;
    float y = 2.0f * u.y - 1.0f;
    bool wide = abs(x) > abs(y);
    float radius = wide ? x : y;
    float across = wide ? y : x;
    // At the centre both are 0.
    vec2 turn = clvCosSinSmall((0.25f * kClvPi) * (across / (radius == 0.0f ? 1.0f : radius)));
    return vec2(radius * (wide ? turn.x : turn.y), radius * (wide ? turn.y : turn.x));
}

// Density by area of a point of the unit disk.
CLV_FN float clvDiskPdf() { return kClvInvPi; }

// The square's point that clvDiskFromSquare maps to `p`.
CLV_FN vec2 clvSquareFromDisk(vec2 p) {
    float radius = sqrt(p.x * p.x + p.y * p.y);
    bool wide = abs(p.x) > abs(p.y);
    float scale = 4.0f * kClvInvPi * radius;
    // The angle from the nearest half axis, of which the square's other coordinate is a multiple.
    float x = wide ? (p.x < 0.0f ? -radius : radius) : scale * clvAtan2(p.x, abs(p.y));
    float y = wide ? scale * clvAtan2(p.y, abs(p.x)) : (p.y < 0.0f ? -radius : radius);
    return vec2(0.5f * x + 0.5f, 0.5f * y + 0.5f);
}

// Direction of unit length around `normal` (unit length), dense as the cosine: a disk's point lifted to the sphere (Malley).
CLV_FN vec3 clvCosineFromSquare(vec2 u, vec3 normal) {
    vec2 p = clvDiskFromSquare(u);
    vec3 tangent;
    vec3 bitangent;
    clvBasis(normal, tangent, bitangent);
    // Clamp before the square root: rounding can put a point outside the disk.
    float z = sqrt(max(0.0f, 1.0f - p.x * p.x - p.y * p.y));
    return normalize(tangent * p.x + bitangent * p.y + normal * z);
}

// Density by solid angle, 1/sr, of a direction that clvCosineFromSquare gives; 0 below the surface.
CLV_FN float clvCosinePdf(vec3 direction, vec3 normal) { return max(0.0f, dot(direction, normal)) * kClvInvPi; }

// The square's point that clvCosineFromSquare maps to `direction`.
CLV_FN vec2 clvSquareFromCosine(vec3 direction, vec3 normal) {
    vec3 tangent;
    vec3 bitangent;
    clvBasis(normal, tangent, bitangent);
    return clvSquareFromDisk(vec2(dot(direction, tangent), dot(direction, bitangent)));
}

// Direction of unit length, uniform over the sphere: heights are uniform (Archimedes).
CLV_FN vec3 clvSphereFromSquare(vec2 u) {
    float z = 1.0f - 2.0f * u.x;
    float radius = sqrt(max(0.0f, 1.0f - z * z));
    float angle = 2.0f * kClvPi * u.y;
    return vec3(radius * cos(angle), radius * sin(angle), z);
}

// Density by solid angle, 1/sr, of a direction that clvSphereFromSquare gives.
CLV_FN float clvSpherePdf() { return 0.25f * kClvInvPi; }

// The square's point that clvSphereFromSquare maps to `direction`.
CLV_FN vec2 clvSquareFromSphere(vec3 direction) {
    float turn = clvAtan2(direction.y, direction.x) * (0.5f * kClvInvPi);
    return vec2(0.5f - 0.5f * direction.z, turn < 0.0f ? turn + 1.0f : turn);
}

CLV_NAMESPACE_END
#endif
