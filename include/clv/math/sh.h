// Real spherical harmonics to l = 2, without the Condon-Shortley phase, and what turns radiance into irradiance.
// Order: (0,0) (1,-1) (1,0) (1,1) (2,-2) (2,-1) (2,0) (2,1) (2,2).
#ifndef CLV_MATH_SH_H
#define CLV_MATH_SH_H
#include "constants.h"
CLV_NAMESPACE_BEGIN

CLV_CONST float kClvSh0 = 0.282094791773878f;    // sqrt(1 / 4 pi)
CLV_CONST float kClvSh1 = 0.488602511902920f;    // sqrt(3 / 4 pi), of x, y and z
CLV_CONST float kClvSh2 = 1.09254843059208f;     // sqrt(15 / 4 pi), of xy, yz and xz
CLV_CONST float kClvSh2Z = 0.315391565252520f;   // sqrt(5 / 16 pi), of 3 z^2 - 1
CLV_CONST float kClvSh2XY = 0.546274215296040f;  // sqrt(15 / 16 pi), of x^2 - y^2

// Irradiance has the coefficients of radiance times these (Ramamoorthi and Hanrahan 2001, equation 8).
CLV_CONST float kClvShCosine0 = 3.14159265358979f;   // pi
CLV_CONST float kClvShCosine1 = 2.09439510239320f;   // 2 pi / 3
CLV_CONST float kClvShCosine2 = 0.785398163397448f;  // pi / 4

// Functions 0 to 3 in a direction of unit length.
CLV_FN vec4 clvShTo3(vec3 d) { return vec4(kClvSh0, kClvSh1 * d.y, kClvSh1 * d.z, kClvSh1 * d.x); }

// Functions 4 to 7 in a direction of unit length.
CLV_FN vec4 clvShTo7(vec3 d) {
    return vec4(kClvSh2 * d.x * d.y, kClvSh2 * d.y * d.z, kClvSh2Z * (3.0f * d.z * d.z - 1.0f), kClvSh2 * d.x * d.z);
}

// Function 8 in a direction of unit length.
CLV_FN float clvShTo8(vec3 d) { return kClvSh2XY * (d.x * d.x - d.y * d.y); }

CLV_NAMESPACE_END
#endif
