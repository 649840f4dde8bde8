// Sends more rays where earlier ones met something. In an open scene most light leaves for the sky and lights nothing.
//
// Space is cut into coarse cells and directions into 24 bins. For each pair the guide knows the share p of earlier rays that met a
// surface. Of rays that contribute with probability p and nothing else, the best density is in proportion to sqrt(p); texels are
// picked by the mean of that over their hemisphere, and a direction by resampling among a few cosine-distributed candidates
// (Talbot, Cline, Egbert 2005). Both weights are divided out of the flux, so the expected light stays the same whatever the guide says.
#ifndef CLV_CPU_RAY_GUIDE_H
#define CLV_CPU_RAY_GUIDE_H
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "../data/ray.h"
#include "level.h"

namespace clv {

class RayGuide {
public:
    static constexpr int kCandidates = 4;
    static constexpr int kBins = 24;

    // Cells over the bounds of the scene, about 16^3 of them.
    RayGuide(const vec3& lo, const vec3& hi) : grid_(volumeOverBounds(lo, hi, 16, kClvStorageCube)) {
        const std::size_t cells = std::size_t(grid_.resolution.x) * grid_.resolution.y * grid_.resolution.z;
        tried_.resize(cells * kBins);
        met_.resize(cells * kBins);
        weight_.resize(cells * kBins, 1.0f);
        cellWeight_.resize(cells, 1.0f);
    }

    // Notes what traced rays met; they start with a density that is proportional to the cosine. Call finish() after the last.
    void learn(std::span<const ClvRay> rays) {
        for (const ClvRay& ray : rays) {
            if (!(ray.maxDistance > 0.0f)) continue;
            const std::size_t bin = std::size_t(cellAt(ray.origin)) * kBins + binOf(ray.direction);
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
        if (!worthwhile()) return;
        for (std::size_t cell = 0; cell < cellWeight_.size(); ++cell) {
            double cellTried = 0.0, cellMet = 0.0;
            for (int b = 0; b < kBins; ++b) cellTried += tried_[cell * kBins + b], cellMet += met_[cell * kBins + b];
            const double inCell = (cellMet + kPrior * share_) / (cellTried + kPrior);
            double sum = 0.0;
            for (int b = 0; b < kBins; ++b) {
                const std::size_t i = cell * kBins + b;
                // Before any ray of its own, a bin is expected to do as well as its cell and its direction do elsewhere.
                const double along = tried[b] > 0.0 ? met[b] / tried[b] : share_;
                const double expected = std::min(1.0, inCell * along / share_);
                const double p = (met_[i] + kPrior * expected) / (tried_[i] + kPrior);
                weight_[i] = float(std::sqrt(std::max(p, kLeastShare)));
                sum += tried_[i] * weight_[i];
            }
            cellWeight_[cell] = cellTried > 0.0 ? float(sum / cellTried) : float(std::sqrt(std::max(share_, kLeastShare)));
        }
    }

    // Share of the rays that met something.
    double share() const { return share_; }
    // A closed scene has nothing to gain.
    bool worthwhile() const { return share_ < kMostShare; }

    // Index of the cell that holds a position (clamped to the grid).
    int cellAt(const vec3& position) const { return int(clvCellIndex(grid_, clvClampCell(grid_, clvCellFromPosition(grid_, position)))); }
    // By which texels in a cell are preferred.
    float texelWeight(int cell) const { return cellWeight_[cell]; }
    // By which a direction (unit length) is preferred.
    float directionWeight(int cell, const vec3& direction) const { return weight_[std::size_t(cell) * kBins + binOf(direction)]; }

private:
    static constexpr double kPrior = 8.0;         // rays that the expectation of a bin counts for
    static constexpr double kLeastShare = 0.03;   // keeps the flux of a ray that was not expected to meet anything within bounds
    static constexpr double kMostShare = 0.9;

    // The axis along which the direction is longest, and the signs of all three components.
    static int binOf(const vec3& d) {
        const vec3 a = abs(d);
        const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
        return 8 * axis + (d.x > 0.0f) + 2 * (d.y > 0.0f) + 4 * (d.z > 0.0f);
    }

    ClvVolume grid_;
    std::vector<std::uint32_t> tried_, met_;
    std::vector<float> weight_, cellWeight_;
    double share_ = 1.0;
};

}  // namespace clv
#endif
