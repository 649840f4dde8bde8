// Picks RSM texels in proportion to their flux, so that every ray carries the same power, or as a guide prefers them.
#ifndef CLV_CPU_TEXEL_SAMPLER_H
#define CLV_CPU_TEXEL_SAMPLER_H
#include <algorithm>
#include <bit>
#include <span>
#include <vector>

#include "../data/rsm_texel.h"
#include "../plan/number_check.h"
#include "parallel.h"
#include "ray_guide.h"

namespace clv {

// Distributions over [0, n), a row each: the inverses of their cumulative sums, searched from a guide table on (Chen and Asau 1974).
// They are sampled many at a time, without branches, so that the compiler makes vectors of it.
class DiscreteRows {
public:
    // rows * (n + 1) must be below 2^31. Keeps its memory. Every row must then be built.
    void resize(int rows, int n) {
        n_ = n;
        sums_.resize(std::size_t(rows) * (n + 1));
        guide_.resize(std::size_t(rows) * n);
        steps_.resize(rows);
    }
    // Weights must be finite and >= 0; weight(i) is asked twice. Returns their sum. Different rows may be built from different threads.
    template <class Weight>
    double build(int row, Weight&& weight) {
        float* sums = sums_.data() + std::size_t(row) * (n_ + 1);
        int* guide = guide_.data() + std::size_t(row) * n_;
        double total = 0.0, sum = 0.0;
        for (int i = 0; i < n_; ++i) total += weight(i);
        // A row without weight is 1 throughout: no u gets past its first item, and the probability there is 0.
        sums[0] = total > 0.0 ? 0.0f : 1.0f;
        for (int i = 0; i < n_; ++i) sums[i + 1] = total > 0.0 ? float((sum += weight(i)) / total) : 1.0f;
        int item = 0, most = 0;
        auto lastBefore = [&](int bucket) {
            while (item + 1 < n_ && (sums[item + 1] == 0.0f || bucketOf(sums[item + 1]) < bucket)) ++item;
            return item;
        };
        for (int bucket = 0; bucket < n_; ++bucket) {
            guide[bucket] = lastBefore(bucket);
            most = std::max(most, lastBefore(bucket + 1) - guide[bucket]);
        }
        steps_[row] = std::bit_floor(unsigned(most));
        return total;
    }
    // Call after the last build().
    void finish() { longestStep_ = steps_.empty() ? 0 : int(*std::max_element(steps_.begin(), steps_.end())); }

    // For each k, the item of row[k] on which u[k], in [0, 1), falls, and its probability. Only items of positive probability come
    // out of a row that has any.
    void sample(int count, const int* __restrict row, const float* __restrict u, int* __restrict item,
                float* __restrict probability) const {
        const int n = n_;
        const float* sums = sums_.data();
        const int* guide = guide_.data();
        for (int k = 0; k < count; ++k) item[k] = guide[row[k] * n + bucketOf(u[k])];
        // The last item whose sum does not exceed u.
        for (int step = longestStep_; step > 0; step /= 2) {
            for (int k = 0; k < count; ++k) {
                const int next = std::min(item[k] + step, n);
                item[k] += sums[row[k] * (n + 1) + next] <= u[k] ? step : 0;
            }
        }
        for (int k = 0; k < count; ++k) {
            const int i = row[k] * (n + 1) + item[k];
            probability[k] = sums[i + 1] - sums[i];
        }
    }

private:
    // Of n equal parts of [0, 1), the one that holds u.
    int bucketOf(float u) const { return int(u * float(n_)); }

    int n_ = 0;
    std::vector<float> sums_;      // n + 1 a row, from 0 to 1
    std::vector<int> guide_;       // n buckets a row: the last item whose sum lies in an earlier bucket
    std::vector<unsigned> steps_;  // a row: the largest power of two among the distances from a bucket's guide to its items
    int longestStep_ = 0;          // of all rows
};

// All RSMs of a frame, stacked: rows of `width` texels. A row is drawn first, then a texel in it, so that both coordinates of a
// sample stay stratified.
class TexelSampler {
public:
    static constexpr int kBlock = 256;

    // texels.size() must be a multiple of width, and below 2^30. The span must outlive the sampler's use, and so must `guide`, which
    // may be null. Allocates only when the size grows.
    void build(std::span<const ClvRsmTexel> texels, int width, const ParallelFor& parallelFor, const RayGuide* guide = nullptr) {
        guide_ = guide && guide->worthwhile() ? guide : nullptr;
        texels_ = texels;
        width_ = width;
        const int height = int(texels.size()) / width;
        rows_.resize(height, width);
        rowFlux_.resize(height);
        parallelFor(std::size_t(height), [&](std::size_t row) {
            rowFlux_[row] = rows_.build(int(row), [&](int i) { return importance(texels_[row * width_ + i]); });
        });
        marginal_.resize(1, height);
        totalFlux_ = marginal_.build(0, [&](int row) { return rowFlux_[row]; });
        rows_.finish();
        marginal_.finish();
    }
    // Whether any texel sends light.
    bool empty() const { return !(totalFlux_ > 0.0); }
    // Sum over the channels of all texels' flux, W; weighted, where there is a guide.
    double totalFlux() const { return totalFlux_; }
    // By which directions are to be chosen, or null.
    const RayGuide* guide() const { return guide_; }

    // Unless empty(), up to kBlock samples at once: for each u[k], v[k] in [0, 1) a texel, and its probability.
    void sample(int count, const float* u, const float* v, ClvRsmTexel* texel, float* probability) const {
        const int only[kBlock] = {};
        int row[kBlock], column[kBlock];
        float inRow[kBlock];
        marginal_.sample(count, only, u, row, probability);
        rows_.sample(count, row, v, column, inRow);
        for (int k = 0; k < count; ++k) {
            texel[k] = texels_[std::size_t(row[k]) * width_ + column[k]];
            probability[k] *= inRow[k];
        }
    }

private:
    double importance(const ClvRsmTexel& texel) const {
        const double sum = double(texel.flux.x) + texel.flux.y + texel.flux.z;
        if (texel.valid == 0u || !liesIn(sum, 0.0, 1e30)) return 0.0;
        return guide_ ? sum * guide_->texelWeight(texel.position) : sum;
    }

    const RayGuide* guide_ = nullptr;
    std::span<const ClvRsmTexel> texels_;
    int width_ = 1;
    DiscreteRows rows_, marginal_;
    std::vector<double> rowFlux_;  // W, summed over the channels
    double totalFlux_ = 0.0;
};

}  // namespace clv
#endif
