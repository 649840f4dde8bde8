// The open regions of a cell that geometry cuts: their volumes, centroids, and the plane that parts the two largest.
//
// The lines of a LineGrid are cut into intervals by their crossings with the scene. Intervals that share a lattice point belong
// to one region. Lengths are exact along a line, so a wall that is square to an axis is measured exactly by that axis' lines;
// axes therefore count by the square of the crossings that they saw.
#ifndef CLV_CPU_CELL_REGIONS_H
#define CLV_CPU_CELL_REGIONS_H
#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "line_grid.h"

namespace clv {

struct OpenRegion {
    float volume = 0.0f;   // m^3
    vec3 centroid{0.0f};   // m, relative to the anchor
    vec3 inside{0.0f};     // a point of the region, near its centroid
};

struct CellRegions {
    bool cut = false;            // a surface crosses the cell
    int count = 0;               // 0: inside a solid; 1; or 2: parted by the plane
    OpenRegion region[2];        // [0] in front of the plane, [1] behind it
    vec3 planeNormal{0.0f};      // unit length
    float planeOffset = 0.0f;    // m
};

// Finds the regions of one cell after another; keeps its memory. One for each piece of work.
class RegionFinder {
public:
    RegionFinder(const ClvVolume& volume, const LineGrid& lines) : volume_(volume), lines_(lines), n_(lines.perCell()) {
        for (auto& axis : nodeAt_) axis.resize(std::size_t(n_) * n_ * n_);
    }

    CellRegions find(const ivec3& cell) {
        cell_ = cell;
        h_ = volume_.cellSize;
        lowest_ = volume_.origin + h_ * vec3(cell);
        nodes_.clear();
        ends_.clear();
        surfaces_.clear();
        CellRegions out;
        for (int axis = 0; axis < 3; ++axis) crossings_[axis] = 0;
        for (int axis = 0; axis < 3; ++axis) {
            for (int j = 0; j < n_; ++j) {
                for (int i = 0; i < n_; ++i) addLine(axis, i, j, out.cut);
            }
        }
        if (!out.cut) {
            out.count = solidAround() ? 0 : 1;
            out.region[0] = {h_ * h_ * h_, lowest_ + vec3(0.5f * h_), lowest_ + vec3(0.5f * h_)};
            return out;
        }
        connect();
        collect(out);
        return out;
    }

private:
    // A piece of a line inside the cell.
    struct Node {
        int parent;
        int axis, i, j;
        float begin, end;      // m from the cell's lowest corner along the axis
        bool enclosed;         // both ways along the line the next surface shows its back
    };
    struct Region {
        float length[3] = {0, 0, 0};     // m, sum over intervals, an axis each
        vec3 moment[3] = {vec3(0), vec3(0), vec3(0)};  // m^2
        float enclosed = 0, total = 0;   // m
        float volume = 0;
        vec3 centroid{0.0f};
        int root = -1;
    };

    // How far from a face of the cell a surface still counts as cutting it, in cells.
    static constexpr float kFaceMargin = 1e-3f;
    // Regions below this share of the cell are too thin to measure or to be read.
    static constexpr float kLeastShare = 1e-4f;
    // Share of a region's length that must be enclosed by backs for it to count as the inside of a solid.
    static constexpr float kSolidShare = 0.95f;

    int root(int k) {
        while (nodes_[k].parent != k) k = nodes_[k].parent = nodes_[nodes_[k].parent].parent;
        return k;
    }
    void unite(int a, int b) {
        a = root(a), b = root(b);
        if (a != b) nodes_[std::max(a, b)].parent = std::min(a, b);
    }
    static ivec3 latticePoint(int axis, int k, int i, int j) {
        ivec3 p;
        p[axis] = k, p[(axis + 1) % 3] = i, p[(axis + 2) % 3] = j;
        return p;
    }
    int& nodeAt(int axis, const ivec3& p) { return nodeAt_[axis][std::size_t(p.x + n_ * (p.y + n_ * p.z))]; }

    void addLine(int axis, int i, int j, bool& cut) {
        auto hits = lines_.line(axis, cell_, i, j);
        const float begin = lines_.cellBegin(axis, cell_);
        const float margin = kFaceMargin * h_;
        auto nearFirst = std::lower_bound(hits.begin(), hits.end(), begin - margin, [](const LineHit& a, float d) { return a.distance < d; });
        auto first = nearFirst;
        while (first != hits.end() && first->distance < begin) ++first;
        auto last = first;
        while (last != hits.end() && last->distance < begin + h_) ++last;
        if (first != nearFirst || last != first || (last != hits.end() && last->distance < begin + h_ + margin)) cut = true;

        float from = 0.0f;
        int k = 0;
        LineEnds ends{int(nodes_.size()), 0};
        for (auto hit = first;; ++hit) {
            const bool atEnd = hit == last;
            const float to = atEnd ? h_ : hit->distance - begin;
            const bool backBelow = hit != hits.begin() && std::prev(hit)->front;
            const bool backAbove = hit != hits.end() && !hit->front;
            const int node = int(nodes_.size());
            nodes_.push_back({node, axis, i, j, from, to, backBelow && backAbove});
            for (; k < n_ && (atEnd || lines_.latticeOffset(axis, k) * h_ < to); ++k) nodeAt(axis, latticePoint(axis, k, i, j)) = node;
            if (atEnd) break;
            crossings_[axis]++;
            vec3 position = lowest_;
            position[axis] += to;
            position[(axis + 1) % 3] += h_ * lines_.latticeOffset((axis + 1) % 3, i);
            position[(axis + 2) % 3] += h_ * lines_.latticeOffset((axis + 2) % 3, j);
            surfaces_.push_back({hit->normal, position});
            from = to;
        }
        ends.last = int(nodes_.size()) - 1;
        ends_.push_back(ends);
    }

    bool solidAround() const {
        return std::all_of(nodes_.begin(), nodes_.end(), [](const Node& node) { return node.enclosed; });
    }

    bool holdsLattice(const Node& node) const {
        for (int k = 0; k < n_; ++k) {
            float p = lines_.latticeOffset(node.axis, k) * h_;
            if (p >= node.begin && p < node.end) return true;
        }
        return false;
    }

    void connect() {
        for (std::size_t p = 0; p < nodeAt_[0].size(); ++p) {
            unite(nodeAt_[0][p], nodeAt_[1][p]);
            unite(nodeAt_[0][p], nodeAt_[2][p]);
        }
        // A sliver at a face of the cell, too thin for a lattice point, belongs to what lies at the same end of the next line.
        auto joinEnds = [&](int a, int b) {
            if (!holdsLattice(nodes_[a]) || !holdsLattice(nodes_[b])) unite(a, b);
        };
        for (int axis = 0; axis < 3; ++axis) {
            const LineEnds* ends = ends_.data() + std::size_t(axis) * n_ * n_;
            for (int j = 0; j < n_; ++j) {
                for (int i = 0; i < n_; ++i) {
                    const LineEnds& e = ends[i + n_ * j];
                    if (i + 1 < n_) joinEnds(e.first, ends[i + 1 + n_ * j].first), joinEnds(e.last, ends[i + 1 + n_ * j].last);
                    if (j + 1 < n_) joinEnds(e.first, ends[i + n_ * (j + 1)].first), joinEnds(e.last, ends[i + n_ * (j + 1)].last);
                }
            }
        }
    }

    vec3 midpoint(const Node& node) const {
        vec3 p;
        p[node.axis] = 0.5f * (node.begin + node.end);
        p[(node.axis + 1) % 3] = h_ * lines_.latticeOffset((node.axis + 1) % 3, node.i);
        p[(node.axis + 2) % 3] = h_ * lines_.latticeOffset((node.axis + 2) % 3, node.j);
        return p;
    }

    void collect(CellRegions& out) {
        regions_.clear();
        regionOf_.assign(nodes_.size(), -1);
        for (int k = 0; k < int(nodes_.size()); ++k) {
            int r = root(k);
            if (regionOf_[r] < 0) {
                regionOf_[r] = int(regions_.size());
                regions_.emplace_back();
                regions_.back().root = r;
            }
            Region& region = regions_[regionOf_[r]];
            const Node& node = nodes_[k];
            const float length = node.end - node.begin;
            region.length[node.axis] += length;
            region.moment[node.axis] += midpoint(node) * length;
            region.total += length;
            if (node.enclosed) region.enclosed += length;
        }
        float axisWeight[3], weights = 0.0f;
        for (int axis = 0; axis < 3; ++axis) weights += axisWeight[axis] = float(crossings_[axis]) * float(crossings_[axis]);
        if (weights == 0.0f) {
            for (float& w : axisWeight) w = 1.0f;
            weights = 3.0f;
        }
        const float cellVolume = h_ * h_ * h_;
        const float perLine = h_ * h_ / float(n_ * n_);
        for (Region& region : regions_) {
            float length = 0.0f, plainLength = 0.0f;
            vec3 moment(0.0f), plainMoment(0.0f);
            for (int axis = 0; axis < 3; ++axis) {
                length += axisWeight[axis] / weights * region.length[axis];
                moment += axisWeight[axis] / weights * region.moment[axis];
                plainLength += region.length[axis];
                plainMoment += region.moment[axis];
            }
            region.volume = length * perLine;
            region.centroid = length > 0.0f ? moment / length : plainMoment / std::max(plainLength, 1e-30f);
        }
        // The inside of a solid never holds light.
        std::erase_if(regions_, [&](const Region& r) {
            return r.enclosed > kSolidShare * r.total || !(r.volume > kLeastShare * cellVolume);
        });
        std::sort(regions_.begin(), regions_.end(), [](const Region& a, const Region& b) {
            float openA = a.volume * (1.0f - a.enclosed / a.total), openB = b.volume * (1.0f - b.enclosed / b.total);
            return openA != openB ? openA > openB : a.root < b.root;
        });
        out.count = std::min<int>(int(regions_.size()), 2);
        for (int r = 0; r < out.count; ++r) out.region[r] = {regions_[r].volume, lowest_ + regions_[r].centroid, pointInside(regions_[r])};
        if (out.count == 2) part(out);
    }

    // The middle of the interval that is nearest to the centroid.
    vec3 pointInside(const Region& region) {
        float best = 1e30f;
        vec3 point = region.centroid;
        for (int k = 0; k < int(nodes_.size()); ++k) {
            if (root(k) != region.root) continue;
            vec3 m = midpoint(nodes_[k]);
            float d = dot(m - region.centroid, m - region.centroid);
            // Longer intervals keep the point away from surfaces.
            d -= 0.25f * (nodes_[k].end - nodes_[k].begin) * (nodes_[k].end - nodes_[k].begin);
            if (d < best) best = d, point = m;
        }
        return lowest_ + point;
    }

    // Fits the plane between two regions: its normal among the surfaces' mean direction and the line between the centroids, its
    // offset where the least length of the regions lies on the wrong side. Not separable: the cell keeps one region.
    void part(CellRegions& out) {
        vec3 apart = out.region[0].centroid - out.region[1].centroid;
        vec3 mean(0.0f);
        for (const Surface& s : surfaces_) mean += s.normal * (dot(s.normal, apart) < 0.0f ? -1.0f : 1.0f);
        float bestWrong = 2.0f;
        const vec3 candidates[2] = {mean, apart};
        for (const vec3& candidate : candidates) {
            float length = glm::length(candidate);
            if (!(length > 0.0f)) continue;
            vec3 normal = candidate / length;
            float offset, wrong = fitOffset(normal, offset);
            if (wrong < bestWrong) {
                bestWrong = wrong;
                out.planeNormal = normal;
                out.planeOffset = offset + dot(normal, lowest_);
            }
        }
        // Two regions that a plane tells apart no better than this are one region around an obstacle.
        if (bestWrong > 0.5f) {
            float a = out.region[0].volume, b = out.region[1].volume;
            out.region[0].centroid = (out.region[0].centroid * a + out.region[1].centroid * b) / (a + b);
            out.region[0].volume = a + b;
            out.count = 1;
        }
    }

    // Offset along `normal` from the cell's lowest corner, and the larger of the two regions' shares on the wrong side.
    float fitOffset(const vec3& normal, float& offset) {
        samples_.clear();
        float total[2] = {0, 0};
        for (int k = 0; k < int(nodes_.size()); ++k) {
            const int r = root(k);
            const int side = r == regions_[0].root ? 0 : r == regions_[1].root ? 1 : -1;
            if (side < 0) continue;
            vec3 p = midpoint(nodes_[k]);
            const float half = 0.5f * (nodes_[k].end - nodes_[k].begin);
            // An interval counts at its two ends and in its middle.
            for (float at : {-1.0f, 0.0f, 1.0f}) {
                vec3 q = p;
                q[nodes_[k].axis] += at * half;
                samples_.push_back({dot(normal, q), 2.0f * half, side});
                total[side] += 2.0f * half;
            }
        }
        std::sort(samples_.begin(), samples_.end(), [](const Sample& a, const Sample& b) {
            return a.at != b.at ? a.at < b.at : a.side > b.side;  // the back region first where both touch the plane
        });
        // Sweeping upwards, everything below the plane should be region 1 and everything above region 0.
        float below0 = 0.0f, below1 = 0.0f, best = 2.0f;
        offset = samples_.empty() ? 0.0f : samples_.front().at;
        for (std::size_t k = 0; k < samples_.size(); ++k) {
            (samples_[k].side == 0 ? below0 : below1) += samples_[k].length;
            const float wrong = std::max(below0 / std::max(total[0], 1e-30f), 1.0f - below1 / std::max(total[1], 1e-30f));
            if (wrong < best) {
                best = wrong;
                offset = k + 1 < samples_.size() ? 0.5f * (samples_[k].at + samples_[k + 1].at) : samples_[k].at;
            }
        }
        return best;
    }

    struct LineEnds {
        int first, last;  // nodes
    };
    struct Surface {
        vec3 normal, position;
    };
    struct Sample {
        float at, length;
        int side;
    };

    const ClvVolume& volume_;
    const LineGrid& lines_;
    int n_;
    ivec3 cell_{0};
    float h_ = 0;
    vec3 lowest_{0.0f};
    int crossings_[3] = {0, 0, 0};
    std::vector<Node> nodes_;
    std::vector<LineEnds> ends_;
    std::vector<Surface> surfaces_;
    std::vector<int> nodeAt_[3];
    std::vector<Region> regions_;
    std::vector<int> regionOf_;
    std::vector<Sample> samples_;
};

}  // namespace clv
#endif
