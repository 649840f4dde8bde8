#include "bindings/embree/task_pool.h"

#include <algorithm>
#include <memory>

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace clv {

ParallelFor tbbParallelFor(int threads) {
    const int cores = tbb::info::default_concurrency();
    auto arena = std::make_shared<tbb::task_arena>(threads > 0 ? std::min(threads, cores) : cores);
    return [arena](std::size_t count, const std::function<void(std::size_t)>& body) {
        arena->execute([&] { tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) { body(i); }, tbb::simple_partitioner{}); });
    };
}

}  // namespace clv
