// Ends the program where a calculation is invalid, divides by zero or overflows, as engines do that look for such faults.
#ifndef CLV_TESTS_SUPPORT_FLOATING_POINT_TRAPS_H
#define CLV_TESTS_SUPPORT_FLOATING_POINT_TRAPS_H
#include <cfenv>

namespace clv::test {

class FloatingPointTraps {
public:
    FloatingPointTraps() {
        std::feclearexcept(FE_ALL_EXCEPT);
        feenableexcept(kFaults);
    }
    ~FloatingPointTraps() { fedisableexcept(kFaults); }
    FloatingPointTraps(const FloatingPointTraps&) = delete;
    FloatingPointTraps& operator=(const FloatingPointTraps&) = delete;

private:
    static constexpr int kFaults = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;
};

}  // namespace clv::test
#endif
