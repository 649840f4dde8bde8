// The order in which rays are walked: neighbours in a packet should cross about as many cells, since a packet runs until its last
// ray ends.
#ifndef CLV_CPU_WALK_ORDER_H
#define CLV_CPU_WALK_ORDER_H
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "../stages/inject.h"

namespace clv {

class WalkOrder {
public:
    static constexpr std::size_t kBlock = 512;  // rays that are put in order at a time

    // Sorts up to kBlock rays by the number of cells that they cross, few first; rays that cross equally many keep their order.
    void sort(const ClvVolume& volume, std::span<const ClvRay> rays) {
        estimateCrossings(volume, rays);
        std::array<int, kBuckets + 1> first{};
        for (std::size_t i = 0; i < rays.size(); ++i) ++first[bucket_[i] + 1];
        for (std::size_t b = 0; b < kBuckets; ++b) first[b + 1] += first[b];
        for (std::size_t i = 0; i < rays.size(); ++i) index_[first[bucket_[i]]++] = int(i);
    }
    // Which ray is the k-th.
    std::size_t operator[](std::size_t k) const { return std::size_t(index_[k]); }

private:
    static constexpr std::size_t kBuckets = 256;  // the last one for all that cross more cells

    void estimateCrossings(const ClvVolume& volume, std::span<const ClvRay> rays) {
        const int count = int(rays.size());
        const vec3 lo = volume.origin, hi = volume.origin + vec3(volume.resolution) * volume.cellSize;
        // Axis by axis on arrays, so that the compiler makes vectors of it.
        float origin[3][kBlock], direction[3][kBlock], enter[kBlock], leave[kBlock], slope[kBlock];
        for (int i = 0; i < count; ++i) {
            const ClvRay& ray = rays[i];
            origin[0][i] = ray.origin.x, origin[1][i] = ray.origin.y, origin[2][i] = ray.origin.z;
            direction[0][i] = ray.direction.x, direction[1][i] = ray.direction.y, direction[2][i] = ray.direction.z;
            enter[i] = 0.0f, leave[i] = ray.maxDistance, slope[i] = 0.0f;
        }
        for (int axis = 0; axis < 3; ++axis) {
            const float low = lo[axis], high = hi[axis];
            for (int i = 0; i < count; ++i) {
                const float d = direction[axis][i], inverse = 1.0f / (std::abs(d) > kClvParallel ? d : kClvParallel);
                const float toLow = (low - origin[axis][i]) * inverse, toHigh = (high - origin[axis][i]) * inverse;
                const float near = std::min(toLow, toHigh), far = std::max(toLow, toHigh);
                enter[i] = std::max(enter[i], near);
                leave[i] = std::min(leave[i], far);
                slope[i] += std::abs(direction[axis][i]);
            }
        }
        const float scale = 1.0f / volume.cellSize;
        for (int i = 0; i < count; ++i) {
            // Written so that NaN, of rays that are not finite, becomes 0.
            bucket_[i] = int(std::min(std::max(0.0f, (leave[i] - enter[i]) * slope[i] * scale), float(kBuckets - 1)));
        }
    }

    std::array<int, kBlock> bucket_;
    std::array<int, kBlock> index_;
};

}  // namespace clv
#endif
