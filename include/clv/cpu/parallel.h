// The caller's thread pool, as the CPU stages see it.
#ifndef CLV_CPU_PARALLEL_H
#define CLV_CPU_PARALLEL_H
#include <cstddef>
#include <functional>

namespace clv {

// Calls body(i) once for every i in [0, count), in any order, on any threads, and returns when all are done.
// Results never depend on who runs what: the stages cut their work into a number of pieces that follows from the work alone.
using ParallelFor = std::function<void(std::size_t count, const std::function<void(std::size_t)>& body)>;

// The plainest one: no threads.
inline ParallelFor serialFor() {
    return [](std::size_t count, const std::function<void(std::size_t)>& body) {
        for (std::size_t i = 0; i < count; ++i) body(i);
    };
}

}  // namespace clv
#endif
