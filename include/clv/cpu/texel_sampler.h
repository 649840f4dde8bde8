// Picks RSM texels in proportion to their flux, so that every ray carries the same power.
#ifndef CLV_CPU_TEXEL_SAMPLER_H
#define CLV_CPU_TEXEL_SAMPLER_H
#include <algorithm>
#include <span>
#include <vector>

#include "../data/rsm_texel.h"
#include "parallel.h"

namespace clv {

// A sampled distribution over [0, n): the inverse of a cumulative sum, started from a guide table (Chen and Asau 1974).
class DiscreteDistribution {
public:
    // Weights must be finite and >= 0. Keeps its memory from build to build.
    template <class Weight>
    void build(std::size_t n, Weight&& weight) {
        cdf_.resize(n + 1);
        guide_.resize(n);
        double sum = 0.0;
        cdf_[0] = 0.0f;
        sums_.resize(n);
        for (std::size_t i = 0; i < n; ++i) sums_[i] = sum += weight(i);
        total_ = sum;
        for (std::size_t i = 0; i < n; ++i) cdf_[i + 1] = sum > 0.0 ? float(sums_[i] / sum) : 0.0f;
        std::size_t item = 0;
        for (std::size_t g = 0; g < n; ++g) {
            while (item + 1 < n && cdf_[item + 1] <= float(g) / float(n)) ++item;
            guide_[g] = std::uint32_t(item);
        }
    }
    double total() const { return total_; }
    // u in [0, 1): the item, and its probability. Only items of positive probability come out, if there are any.
    std::size_t sample(float u, float& probability) const {
        const std::size_t n = guide_.size();
        std::size_t i = guide_[std::min(n - 1, std::size_t(u * float(n)))];
        while (i > 0 && cdf_[i] > u) --i;  // the product above may round up
        while (i + 1 < n && cdf_[i + 1] <= u) ++i;
        while (i > 0 && cdf_[i + 1] == cdf_[i]) --i;  // behind the last item of positive weight
        probability = cdf_[i + 1] - cdf_[i];
        return i;
    }

private:
    std::vector<float> cdf_;
    std::vector<double> sums_;
    std::vector<std::uint32_t> guide_;
    double total_ = 0.0;
};

// All RSMs of a frame, stacked: rows of `width` texels. A row is drawn first, then a texel in it, so that both coordinates of a
// sample stay stratified.
class TexelSampler {
public:
    // texels.size() must be a multiple of width. The span must outlive the sampler's use. Allocates only when the size grows.
    void build(std::span<const ClvRsmTexel> texels, int width, const ParallelFor& parallelFor) {
        texels_ = texels;
        width_ = std::size_t(width);
        rows_.resize(texels.size() / width_);
        parallelFor(rows_.size(), [&](std::size_t row) {
            rows_[row].build(width_, [&](std::size_t i) { return importance(texels_[row * width_ + i]); });
        });
        marginal_.build(rows_.size(), [&](std::size_t row) { return rows_[row].total(); });
    }
    // Whether any texel sends light.
    bool empty() const { return !(marginal_.total() > 0.0); }
    // Sum over the channels of all texels' flux, W.
    double totalFlux() const { return marginal_.total(); }

    // u, v in [0, 1): a texel, and its probability.
    const ClvRsmTexel& sample(float u, float v, float& probability) const {
        float inRow = 0.0f;
        const std::size_t row = marginal_.sample(u, probability);
        const std::size_t column = rows_[row].sample(v, inRow);
        probability *= inRow;
        return texels_[row * width_ + column];
    }

private:
    static double importance(const ClvRsmTexel& texel) {
        const double sum = double(texel.flux.x) + texel.flux.y + texel.flux.z;
        return texel.valid != 0u && sum > 0.0 && sum < 1e30 ? sum : 0.0;
    }

    std::span<const ClvRsmTexel> texels_;
    std::size_t width_ = 1;
    std::vector<DiscreteDistribution> rows_;
    DiscreteDistribution marginal_;
};

}  // namespace clv
#endif
