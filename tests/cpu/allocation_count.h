// How often this test program has taken memory from the heap, by any thread; counted in moving_allocation_test.cpp.
#ifndef CLV_TESTS_CPU_ALLOCATION_COUNT_H
#define CLV_TESTS_CPU_ALLOCATION_COUNT_H
#include <cstddef>

namespace clv::test {

std::size_t allocationCount();

}  // namespace clv::test
#endif
