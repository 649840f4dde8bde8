// Finiteness by the bits, which no compiler's fast-math assumption folds away.
#ifndef CLV_MATH_FINITE_H
#define CLV_MATH_FINITE_H
#include "../lang.h"
CLV_NAMESPACE_BEGIN

CLV_FN bool clvIsNan(float x) { return (clvBitsFromFloat(x) & 0x7fffffffu) > 0x7f800000u; }

// Neither infinite nor NaN?
CLV_FN bool clvIsFinite(float x) { return (clvBitsFromFloat(x) & 0x7f800000u) != 0x7f800000u; }
CLV_FN bool clvIsFinite(vec3 v) { return clvIsFinite(v.x) && clvIsFinite(v.y) && clvIsFinite(v.z); }

CLV_NAMESPACE_END
#endif
