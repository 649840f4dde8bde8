#include "clv/cpu/walk_order.h"

#include <algorithm>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "clv/cpu/level.h"
#include "clv/stages/inject.h"
#include "support/chi_square.h"

namespace clv::test {
namespace {

constexpr int kResolution = 32;

ClvVolume grid() { return volumeOverBounds(vec3(-1.0f), vec3(1.0f), kResolution, kClvStorageCube); }

// From all over a box twice as wide as the grid, of all lengths.
std::vector<ClvRay> rays(std::size_t count, uint seed) {
    std::vector<ClvRay> result(count);
    for (uint i = 0; i < count; ++i) {
        const vec3 unit(randomUnit(seed, 4 * i), randomUnit(seed, 4 * i + 1), randomUnit(seed, 4 * i + 2));
        result[i] = {4.0f * unit - 2.0f, 3.0f * randomUnit(seed, 4 * i + 3), randomDirection(seed + 1, i), 0.0f, vec3(1.0f), 0.0f};
    }
    return result;
}

int crossings(const ClvVolume& volume, const ClvRay& ray) {
    int count = 0;
    for (ClvWalk walk = clvWalkBegin(volume, ray); walk.running; ++count) clvWalkStep(walk, ray.direction);
    return count;
}

std::vector<std::size_t> sorted(const ClvVolume& volume, std::span<const ClvRay> rays) {
    WalkOrder order;
    order.sort(volume, rays);
    std::vector<std::size_t> result(rays.size());
    for (std::size_t k = 0; k < rays.size(); ++k) result[k] = order[k];
    return result;
}

TEST(WalkOrder, holdsEachRayOnceWhateverItsNumbersAre) {
    const ClvVolume volume = grid();
    const float nan = std::numeric_limits<float>::quiet_NaN(), endless = std::numeric_limits<float>::infinity();
    for (std::size_t count : {std::size_t(1), std::size_t(17), WalkOrder::kBlock}) {
        std::vector<ClvRay> all = rays(count, 3);
        for (std::size_t i = 0; i < count; i += 7) {
            const float strange[] = {nan, endless, -endless, 0.0f, 1e38f};
            all[i].origin[int(i % 3)] = strange[i % 5];
            all[count - 1 - i].direction = vec3(0, i % 2 ? 1 : -1, strange[(i + 1) % 5]);
            all[i].maxDistance = strange[(i + 2) % 5];
        }
        all[0].origin = volume.origin;  // along the rim of the grid: 0 / 0
        all[0].direction = vec3(0, 0, 1);
        std::vector<std::size_t> order = sorted(volume, all);
        std::sort(order.begin(), order.end());
        for (std::size_t k = 0; k < count; ++k) EXPECT_EQ(order[k], k);
    }
}

TEST(WalkOrder, raysThatCrossEquallyManyCellsKeepTheirOrder) {
    std::vector<ClvRay> all(100, ClvRay{vec3(0.0f), 1.0f, vec3(1, 0, 0), 0.0f, vec3(1.0f), 0.0f});
    all[60].maxDistance = 0.0f;
    const std::vector<std::size_t> order = sorted(grid(), all);
    EXPECT_EQ(order[0], 60u);
    EXPECT_TRUE(std::is_sorted(order.begin() + 1, order.end()));
}

TEST(WalkOrder, neighboursInOrderCrossAboutAsManyCells) {
    const ClvVolume volume = grid();
    const std::vector<ClvRay> all = rays(WalkOrder::kBlock, 11);
    const std::vector<std::size_t> order = sorted(volume, all);
    // The walk's number differs from the length along the axes by less than one cell an axis.
    int before = 0;
    for (std::size_t k : order) {
        const int now = crossings(volume, all[k]);
        EXPECT_GE(now + 4, before);
        before = std::max(before, now);
    }
    EXPECT_GT(before, kResolution);
}

}  // namespace
}  // namespace clv::test
