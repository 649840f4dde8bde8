#include "bindings/embree/task_pool.h"

#include <memory>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace clv {

ParallelFor tbbParallelFor(int threads) {
    constexpr int kAll = tbb::task_arena::automatic;
    auto arena = std::make_shared<tbb::task_arena>(threads > 0 ? threads : kAll);
    return [arena](std::size_t count, const std::function<void(std::size_t)>& body) {
        arena->execute([&] { tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) { body(i); }, tbb::simple_partitioner{}); });
    };
}

}  // namespace clv
