// Constants that every stage shares.
#ifndef CLV_MATH_CONSTANTS_H
#define CLV_MATH_CONSTANTS_H
#include "../lang.h"
CLV_NAMESPACE_BEGIN

CLV_CONST float kClvPi = 3.14159265358979f;
CLV_CONST float kClvInvPi = 0.318309886183791f;
// Longest ray, m. Squares of it are finite in a float.
CLV_CONST float kClvFar = 1e18f;

CLV_NAMESPACE_END
#endif
