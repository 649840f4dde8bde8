#include "bindings/embree/task_pool.h"

#include <atomic>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace clv::test {
namespace {

TEST(TaskPool, everyItemRunsOnce) {
    for (int threads : {0, 1, 2, 5}) {
        const ParallelFor parallelFor = tbbParallelFor(threads);
        std::vector<std::atomic<int>> runs(1000);
        parallelFor(runs.size(), [&](std::size_t i) { ++runs[i]; });
        for (const std::atomic<int>& count : runs) EXPECT_EQ(count, 1);
    }
}

TEST(TaskPool, noItemsIsNoWork) {
    tbbParallelFor(2)(0, [](std::size_t) { FAIL() << "nothing was asked for"; });
}

TEST(TaskPool, neverMoreThreadsThanAskedFor) {
    for (int threads : {1, 2}) {
        std::atomic<int> running{0}, most{0};
        tbbParallelFor(threads)(2000, [&](std::size_t) {
            const int now = ++running;
            for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) {}
            --running;
        });
        EXPECT_LE(most, threads);
    }
}

TEST(TaskPool, loopsMayNest) {
    const ParallelFor parallelFor = tbbParallelFor(2);
    std::atomic<int> runs{0};
    parallelFor(8, [&](std::size_t) { parallelFor(8, [&](std::size_t) { ++runs; }); });
    EXPECT_EQ(runs, 64);
}

TEST(TaskPool, failuresReachTheCaller) {
    EXPECT_THROW(tbbParallelFor(2)(100, [](std::size_t i) { if (i == 42) throw std::runtime_error("item 42"); }), std::runtime_error);
}

}  // namespace
}  // namespace clv::test
