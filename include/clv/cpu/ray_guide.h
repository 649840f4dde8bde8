// Sends more rays where earlier ones met something. In an open scene most light leaves for the sky and lights nothing.
//
// Space is cut into coarse cells and directions into 24 bins. For each pair the guide knows the share p of earlier rays that met a
// surface. Of rays that contribute with probability p and nothing else, the best density is in proportion to sqrt(p); texels are
// picked by the mean of that over their hemisphere, and a direction by resampling among a few cosine-distributed candidates
// (Talbot, Cline, Egbert 2005). Both weights are divided out of the flux, so the expected light stays the same whatever the guide says.
#ifndef CLV_CPU_RAY_GUIDE_H
#define CLV_CPU_RAY_GUIDE_H
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "../data/ray.h"
#include "../stages/ray_guide.h"
#include "level.h"

namespace clv {

class RayGuide {
public:
    // Cells over the bounds of the scene, about 16^3 of them.
    RayGuide(const vec3& lo, const vec3& hi) : grid_(volumeOverBounds(lo, hi, 16, kClvStorageCube)) {
        const std::size_t cells = std::size_t(grid_.resolution.x) * grid_.resolution.y * grid_.resolution.z;
        tried_.resize(cells * kBins);
        met_.resize(cells * kBins);
        row_.resize(cells, 0);
        weight_.resize((cells + 1) * kClvGuideRow, 1.0f);
    }

    // Notes what traced rays met; they start with a density that is proportional to the cosine. Call finish() after the last.
    void learn(std::span<const ClvRay> rays) {
        for (const ClvRay& ray : rays) {
            if (!(ray.maxDistance > 0.0f)) continue;
            const uint cell = clvCellIndex(grid_, clvClampCell(grid_, clvCellFromPosition(grid_, ray.origin)));
            const std::size_t bin = std::size_t(cell) * kBins + clvGuideBin(ray.direction.x, ray.direction.y, ray.direction.z);
            tried_[bin]++;
            met_[bin] += ray.maxDistance < kClvFar;
        }
    }

    void finish() {
        std::array<double, kBins> tried{}, met{};
        double allTried = 0.0, allMet = 0.0;
        for (std::size_t i = 0; i < tried_.size(); ++i) {
            tried[i % kBins] += tried_[i], met[i % kBins] += met_[i];
            allTried += tried_[i], allMet += met_[i];
        }
        share_ = allTried > 0.0 ? allMet / allTried : 1.0;
        if (!worthwhile() || share_ == 0.0) return;
        // Row 0 is for cells that no ray has left yet.
        rows_ = 1;
        fillRow(0, nullptr, nullptr, tried, met);
        for (std::size_t cell = 0; cell < row_.size(); ++cell) {
            const std::uint32_t* cellTried = tried_.data() + cell * kBins;
            if (std::all_of(cellTried, cellTried + kBins, [](std::uint32_t n) { return n == 0; })) continue;
            row_[cell] = rows_++;
            fillRow(row_[cell], cellTried, met_.data() + cell * kBins, tried, met);
        }
    }

    // Share of the rays that met something.
    double share() const { return share_; }
    // Where most light stays in the scene, there is less to gain than the choice of directions costs.
    bool worthwhile() const { return share_ < kMostShare; }

    // By which texels at a position are preferred.
    float texelWeight(const vec3& position) const { return clvGuideTexelWeight(*this, rowAt(position)); }

    // For each k, by which direction (x[k], y[k], z[k]), of unit length, is preferred at a position whose row is row[k].
    void directionWeights(int count, const uint* __restrict row, const float* __restrict x, const float* __restrict y,
                          const float* __restrict z, float* __restrict weight) const {
        const float* weights = weight_.data();
        for (int k = 0; k < count; ++k) weight[k] = weights[row[k] + clvGuideBin(x[k], y[k], z[k])];
    }
    uint rowAt(const vec3& position) const { return clvGuideRowAt(*this, grid_, position); }

    // What a frame on the GPU needs to know: see stages/ray_guide.h.
    const ClvVolume& grid() const { return grid_; }
    std::span<const uint> cells() const { return row_; }
    std::span<const float> weights() const { return std::span(weight_).first(std::size_t(rows_) * kClvGuideRow); }
    uint clvReadGuideCell(uint cell) const { return row_[cell]; }
    float clvReadGuideWeight(uint index) const { return weight_[index]; }

    // The most by which the guide raises the flux of a ray above that of an unguided one.
    float largestGain() const {
        const auto [least, most] = std::ranges::minmax(weights());
        return (most / least) * (most / least);
    }

private:
    static constexpr std::size_t kBins = kClvGuideBins;
    static constexpr double kPrior = 8.0;         // rays that the expectation of a bin counts for
    static constexpr double kLeastShare = 0.03;   // keeps the flux of a ray that was not expected to meet anything within bounds
    static constexpr double kMostShare = 0.75;

    // What a cell has seen, and where that is little, what is to be expected: as good as the cell and the direction are elsewhere.
    void fillRow(uint row, const std::uint32_t* tried, const std::uint32_t* met, const std::array<double, kBins>& allTried,
                 const std::array<double, kBins>& allMet) {
        float* weights = weight_.data() + std::size_t(row) * kClvGuideRow;
        double cellTried = 0.0, cellMet = 0.0;
        for (std::size_t b = 0; tried && b < kBins; ++b) cellTried += tried[b], cellMet += met[b];
        const double inCell = (cellMet + kPrior * share_) / (cellTried + kPrior);
        double sum = 0.0;
        for (std::size_t b = 0; b < kBins; ++b) {
            const double along = allTried[b] > 0.0 ? allMet[b] / allTried[b] : share_;
            const double expected = std::min(1.0, inCell * along / share_);
            const double p = tried ? (met[b] + kPrior * expected) / (tried[b] + kPrior) : expected;
            weights[b] = float(std::sqrt(std::max(p, kLeastShare)));
            if (tried) sum += tried[b] * weights[b];
        }
        weights[kBins] = cellTried > 0.0 ? float(sum / cellTried) : float(std::sqrt(std::max(share_, kLeastShare)));
    }

    ClvVolume grid_;
    std::vector<std::uint32_t> tried_, met_;
    std::vector<uint> row_;           // a cell each
    std::vector<float> weight_;       // of each row: a bin each, then their mean over the rays that left there
    uint rows_ = 1;
    double share_ = 1.0;
};

}  // namespace clv
#endif
