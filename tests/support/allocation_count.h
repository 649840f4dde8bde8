// How often a test program has taken memory from the heap, by any thread; and memory that runs out. Replaces operator new: include it in one file
// of a program.
#ifndef CLV_TESTS_SUPPORT_ALLOCATION_COUNT_H
#define CLV_TESTS_SUPPORT_ALLOCATION_COUNT_H
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <new>

namespace clv::test {

inline std::atomic<std::size_t> allocations{0};
inline std::size_t allocationCount() { return allocations; }

// No memory is left from this allocation on, counted as above.
inline std::atomic<std::size_t> firstFailure{std::numeric_limits<std::size_t>::max()};

// Null where there is no memory.
inline void* tryAllocate(std::size_t size, std::size_t alignment) {
    if (++allocations >= firstFailure) return nullptr;
    return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

inline void* allocate(std::size_t size, std::size_t alignment) {
    void* memory = tryAllocate(size, alignment);
    if (!memory) throw std::bad_alloc();
    return memory;
}

}  // namespace clv::test

// Not inlined: where the compiler sees the half of a pair alone, it takes it for a mismatch with the other.
[[gnu::noinline]] void* operator new(std::size_t size) { return clv::test::allocate(size, alignof(std::max_align_t)); }
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) { return clv::test::allocate(size, std::size_t(alignment)); }
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return clv::test::tryAllocate(size, alignof(std::max_align_t)); }
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
#endif
