// Checks of numbers that hold in every build: by the bits, which no compiler's fast-math assumption folds away.
#ifndef CLV_PLAN_NUMBER_CHECK_H
#define CLV_PLAN_NUMBER_CHECK_H
#include <bit>
#include <cstdint>
#include <limits>

namespace clv {

// Neither infinite nor NaN?
inline bool isFinite(double x) { return (std::bit_cast<std::uint64_t>(x) >> 52 & 0x7ffu) != 0x7ffu; }

// Whether a number is finite and lies in [least, most].
inline bool liesIn(double x, double least, double most = std::numeric_limits<double>::max()) { return isFinite(x) && x >= least && x <= most; }

}  // namespace clv
#endif
