// What a cell stores: the light that crosses it, projected on a few directional functions, and how that is read for a normal.
//
// A cell holds one sum a coefficient and colour channel: sum over rays of flux * f_k(direction) * length inside the cell, W m.
// Divided by the cell's open volume, m^3, it is the mean of coefficient k, W/m^2. Irradiance is linear in the coefficients.
#ifndef CLV_DATA_CELL_H
#define CLV_DATA_CELL_H
#include "../math/sh.h"
CLV_NAMESPACE_BEGIN

CLV_CONST uint kClvStorageCube = 0u;   // ambient cube: irradiance on the six sides +x -x +y -y +z -z
CLV_CONST uint kClvStorageCube9 = 1u;  // the six sides and the second-order terms xy, yz, xz
CLV_CONST uint kClvStorageSh1 = 2u;    // spherical harmonics of radiance to l = 1
CLV_CONST uint kClvStorageSh2 = 3u;    // spherical harmonics of radiance to l = 2

// Up to nine values, one a coefficient; those that a storage does not have are 0.
struct ClvCoefficients {
    vec4 a;   // 0 to 3
    vec4 b;   // 4 to 7
    float c;  // 8
};

// Number of coefficients a channel, 4 to 9.
CLV_FN uint clvCoefficientCount(uint storage) {
    if (storage == kClvStorageCube) return 6u;
    if (storage == kClvStorageSh1) return 4u;
    return 9u;
}

// f_k: what a ray of unit flux that travels along `direction` (unit length) adds per metre.
CLV_FN ClvCoefficients clvDepositCoefficients(uint storage, vec3 direction) {
    ClvCoefficients f;
    vec3 w = vec3(-direction.x, -direction.y, -direction.z);  // where the light comes from
    if (storage == kClvStorageSh1 || storage == kClvStorageSh2) {
        f.a = clvShTo3(w);
        f.b = storage == kClvStorageSh2 ? clvShTo7(w) : vec4(0.0f, 0.0f, 0.0f, 0.0f);
        f.c = storage == kClvStorageSh2 ? clvShTo8(w) : 0.0f;
        return f;
    }
    f.a = vec4(max(w.x, 0.0f), max(-w.x, 0.0f), max(w.y, 0.0f), max(-w.y, 0.0f));
    f.b = vec4(max(w.z, 0.0f), max(-w.z, 0.0f), 0.0f, 0.0f);
    f.c = 0.0f;
    if (storage == kClvStorageCube9) {
        f.b.z = w.x * w.y;
        f.b.w = w.y * w.z;
        f.c = w.x * w.z;
    }
    return f;
}

// r_k: irradiance on a surface with this normal (unit length) is the sum of r_k times coefficient k, clamped at 0.
//
// Cube: an axis contributes n_i^2 (E+ + E-)/2 + n_i (E+ - E-)/2. The odd part is exact, since the odd part of max(0, x) is x/2.
// Cube9 adds the terms of second order that the six sides miss: the cosine lobe's l = 2 band is 5/16 P2 (Ramamoorthi and
// Hanrahan 2001), whose mixed products carry 15/16 n_i n_j.
CLV_FN ClvCoefficients clvReadCoefficients(uint storage, vec3 n) {
    ClvCoefficients r;
    if (storage == kClvStorageSh1 || storage == kClvStorageSh2) {
        r.a = clvShTo3(n) * vec4(kClvShCosine0, kClvShCosine1, kClvShCosine1, kClvShCosine1);
        r.b = storage == kClvStorageSh2 ? clvShTo7(n) * kClvShCosine2 : vec4(0.0f, 0.0f, 0.0f, 0.0f);
        r.c = storage == kClvStorageSh2 ? clvShTo8(n) * kClvShCosine2 : 0.0f;
        return r;
    }
    r.a = vec4(0.5f * (n.x * n.x + n.x), 0.5f * (n.x * n.x - n.x), 0.5f * (n.y * n.y + n.y), 0.5f * (n.y * n.y - n.y));
    r.b = vec4(0.5f * (n.z * n.z + n.z), 0.5f * (n.z * n.z - n.z), 0.0f, 0.0f);
    r.c = 0.0f;
    if (storage == kClvStorageCube9) {
        r.b.z = 0.9375f * n.x * n.y;
        r.b.w = 0.9375f * n.y * n.z;
        r.c = 0.9375f * n.x * n.z;
    }
    return r;
}

// Valve's reading of an ambient cube (McTaggart 2004), kept for comparison: n_i^2 times the side that the normal points to.
CLV_FN ClvCoefficients clvReadCoefficientsSquared(vec3 n) {
    ClvCoefficients r;
    r.a = vec4(n.x > 0.0f ? n.x * n.x : 0.0f, n.x < 0.0f ? n.x * n.x : 0.0f, n.y > 0.0f ? n.y * n.y : 0.0f,
               n.y < 0.0f ? n.y * n.y : 0.0f);
    r.b = vec4(n.z > 0.0f ? n.z * n.z : 0.0f, n.z < 0.0f ? n.z * n.z : 0.0f, 0.0f, 0.0f);
    r.c = 0.0f;
    return r;
}

CLV_FN float clvDotCoefficients(ClvCoefficients x, ClvCoefficients y) {
    return dot(x.a, y.a) + dot(x.b, y.b) + x.c * y.c;
}

CLV_NAMESPACE_END
#endif
