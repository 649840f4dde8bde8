// The open regions of a cell that geometry cuts: their volumes, centroids, and the tree of planes that parts them.
//
// The lines of a LineGrid are cut into intervals by their crossings with the scene. Intervals that share a lattice point belong
// to one region. Lengths are exact along a line, so a wall that is square to an axis is measured exactly by that axis' lines;
// axes therefore count by the square of the crossings that they saw.
#ifndef CLV_CPU_CELL_REGIONS_H
#define CLV_CPU_CELL_REGIONS_H
#include <algorithm>
#include <vector>

#include "line_grid.h"
#include "region_tree.h"

namespace clv {

struct OpenRegion {
    float volume = 0.0f;   // m^3
    vec3 centroid{0.0f};   // m, relative to the anchor
    vec3 inside{0.0f};     // a point of the region, near its centroid and clear of surfaces
};

struct CellRegions {
    bool cut = false;                     // a surface crosses the cell
    std::vector<OpenRegion> regions;      // none inside a solid; at most kClvMostSlots
    std::vector<RegionSplit> splits;      // none, or a tree with its root first
};

// Finds the regions of one cell after another; keeps its memory. One for each piece of work.
class RegionFinder {
public:
    // What find() says stays until it is called again.
    const CellRegions& find(const LineGrid& lines, const ivec3& cell) {
        lines_ = &lines;
        n_ = lines.perCell();
        for (auto& axis : nodeAt_) axis.resize(std::size_t(n_) * n_ * n_);
        cell_ = cell;
        h_ = lines.volume().cellSize;
        lowest_ = lines.volume().origin + h_ * vec3(cell);
        nodes_.clear();
        ends_.clear();
        surfaces_.clear();
        CellRegions& out = found_;
        out.regions.clear();
        out.splits.clear();
        out.cut = crossLines();
        if (!out.cut) {
            if (!solidAround()) out.regions.push_back({h_ * h_ * h_, lowest_ + vec3(0.5f * h_), lowest_ + vec3(0.5f * h_)});
            return out;
        }
        for (int axis = 0; axis < 3; ++axis) {
            crossings_[axis] = 0;
            lattice_[axis].resize(std::size_t(n_));
            for (int k = 0; k < n_; ++k) lattice_[axis][k] = lines.latticeOffset(axis, k) * h_;
        }
        for (int axis = 0; axis < 3; ++axis) {
            for (int j = 0; j < n_; ++j) {
                for (int i = 0; i < n_; ++i) addLine(axis, i, j);
            }
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
        int below, above;      // what the next surface shows, down and up the line: 1 its front, -1 its back, 0 there is none
        int fronts() const { return (below > 0) + (above > 0); }
        int backs() const { return (below < 0) + (above < 0); }
    };
    struct Region {
        int root = -1;
        float bounded = 0, enclosed = 0;  // m, of the intervals that end at a surface, and of those between two backs
        float volume = 0;                 // m^3
        float fronts = 0, backs = 0;      // m, of the intervals that see them
        // How much of the region looks out on front faces. What lies behind the walls of a room sees backs only.
        float openness() const { return fronts > 0.0f ? fronts / (fronts + backs) : 0.0f; }
        float rank() const { return volume * openness() * openness() * openness(); }
    };
    struct LineEnds {
        int first, last;  // nodes
    };
    // A line and its hits [first, last) inside the cell.
    struct Crossed {
        std::span<const LineHit> hits;
        std::size_t first, last;
    };
    struct Surface {
        vec3 normal, position;
        int axis, below;  // the line's axis, and the node that ends here; the next node begins here
    };
    // Pieces into which an interval is cut to see on which side of a plane it lies.
    static constexpr int kSteps = 4;
    // How far from a face of the cell a surface still counts as cutting it, in cells.
    static constexpr float kFaceMargin = 1e-3f;
    // Regions below this share of the cell are too thin to measure or to be read.
    static constexpr float kLeastShare = 1e-4f;
    // Share of a region's length that must be enclosed by backs for it to count as the inside of a solid. Lines that meet nothing say
    // nothing: they may begin and end inside of one.
    static constexpr float kSolidShare = 0.95f;
    // Surfaces that are looked at in one round.
    static constexpr std::size_t kLanes = 16;

    int root(int k) {
        while (nodes_[k].parent != k) k = nodes_[k].parent = nodes_[nodes_[k].parent].parent;
        return k;
    }
    void unite(int a, int b) {
        a = root(a), b = root(b);
        if (a != b) nodes_[std::max(a, b)].parent = std::min(a, b);
    }
    // The same, fast for nodes that are known to belong together.
    void uniteOnce(int a, int b) {
        if (nodes_[a].parent != nodes_[b].parent) unite(a, b);
    }
    static ivec3 latticePoint(int axis, int k, int i, int j) {
        ivec3 p;
        p[axis] = k, p[(axis + 1) % 3] = i, p[(axis + 2) % 3] = j;
        return p;
    }
    int& nodeAt(int axis, const ivec3& p) { return nodeAt_[axis][std::size_t(p.x + n_ * (p.y + n_ * p.z))]; }

    // What the next surface shows where a piece of a line ends, down and up the line.
    static int shownBelow(std::span<const LineHit> hits, std::size_t next) { return next == 0 ? 0 : hits[next - 1].front ? -1 : 1; }
    static int shownAbove(std::span<const LineHit> hits, std::size_t next) { return next == hits.size() ? 0 : hits[next].front ? 1 : -1; }

    // Finds what each line crosses inside the cell. Returns whether a surface cuts the cell, or touches a face of it.
    bool crossLines() {
        crossed_.clear();
        bool cut = false;
        const float margin = kFaceMargin * h_;
        for (int axis = 0; axis < 3; ++axis) {
            const float begin = lines_->cellBegin(axis, cell_);
            for (int j = 0; j < n_; ++j) {
                for (int i = 0; i < n_; ++i) {
                    const std::span<const LineHit> hits = lines_->line(axis, cell_, i, j);
                    const auto near = std::lower_bound(hits.begin(), hits.end(), begin - margin, [](const LineHit& a, float d) { return a.distance < d; });
                    Crossed line{hits, std::size_t(near - hits.begin()), 0};
                    const std::size_t nearFirst = line.first;
                    while (line.first < hits.size() && hits[line.first].distance < begin) ++line.first;
                    line.last = line.first;
                    while (line.last < hits.size() && hits[line.last].distance < begin + h_) ++line.last;
                    cut = cut || line.last != nearFirst || (line.last < hits.size() && hits[line.last].distance < begin + h_ + margin);
                    crossed_.push_back(line);
                }
            }
        }
        return cut;
    }

    // Cuts a line into nodes where it crosses surfaces.
    void addLine(int axis, int i, int j) {
        const Crossed& line = crossed_[std::size_t(axis) * n_ * n_ + std::size_t(i + n_ * j)];
        const float begin = lines_->cellBegin(axis, cell_);
        const ivec3 start = latticePoint(axis, 0, i, j), next = latticePoint(axis, 1, i, j) - start;
        int* at = &nodeAt(axis, start);
        const int step = next.x + n_ * (next.y + n_ * next.z);
        float from = 0.0f;
        int k = 0;
        LineEnds ends{int(nodes_.size()), 0};
        for (std::size_t hit = line.first;; ++hit) {
            const bool atEnd = hit == line.last;
            const float to = atEnd ? h_ : line.hits[hit].distance - begin;
            const int node = int(nodes_.size());
            nodes_.push_back({node, axis, i, j, from, to, shownBelow(line.hits, hit), shownAbove(line.hits, hit)});
            for (; k < n_ && (atEnd || lattice_[axis][k] < to); ++k) at[k * step] = node;
            if (atEnd) break;
            crossings_[axis]++;
            vec3 position(0.0f);  // from the lowest corner
            position[axis] += to;
            position[(axis + 1) % 3] += lattice_[(axis + 1) % 3][i];
            position[(axis + 2) % 3] += lattice_[(axis + 2) % 3][j];
            surfaces_.push_back({line.hits[hit].normal, position, axis, node});
            from = to;
        }
        ends.last = int(nodes_.size()) - 1;
        ends_.push_back(ends);
    }

    // For a cell that nothing cuts: whether all lines that meet something lie between backs.
    bool solidAround() const {
        if (!lines_->solids()) return false;
        bool enclosed = false, open = false;
        for (const Crossed& line : crossed_) {
            const int below = shownBelow(line.hits, line.first), above = shownAbove(line.hits, line.first);
            (below < 0 && above < 0 ? enclosed : open) |= below != 0 || above != 0;
        }
        return enclosed && !open;
    }

    bool holdsLattice(const Node& node) const {
        for (int k = 0; k < n_; ++k) {
            const float p = lattice_[node.axis][k];
            if (p >= node.begin && p < node.end) return true;
        }
        return false;
    }

    void connect() {
        for (std::size_t p = 0; p < nodeAt_[0].size(); ++p) {
            uniteOnce(nodeAt_[0][p], nodeAt_[1][p]);
            uniteOnce(nodeAt_[0][p], nodeAt_[2][p]);
        }
        // A sliver at a face of the cell, too thin for a lattice point, belongs to what lies at the same end of the next line, if both
        // end at the same side of a surface.
        auto joinEnds = [&](int a, int b, bool low) {
            const int faceA = low ? nodes_[a].above : nodes_[a].below, faceB = low ? nodes_[b].above : nodes_[b].below;
            const bool bothCut = nodes_[a].end - nodes_[a].begin < h_ && nodes_[b].end - nodes_[b].begin < h_;
            if (bothCut && faceA == faceB && (!holdsLattice(nodes_[a]) || !holdsLattice(nodes_[b]))) unite(a, b);
        };
        for (int axis = 0; axis < 3; ++axis) {
            const LineEnds* ends = ends_.data() + std::size_t(axis) * n_ * n_;
            for (int j = 0; j < n_; ++j) {
                for (int i = 0; i < n_; ++i) {
                    const LineEnds& e = ends[i + n_ * j];
                    for (const LineEnds* next : {i + 1 < n_ ? &ends[i + 1 + n_ * j] : nullptr, j + 1 < n_ ? &ends[i + n_ * (j + 1)] : nullptr}) {
                        if (!next) continue;
                        joinEnds(e.first, next->first, true);
                        joinEnds(e.last, next->last, false);
                    }
                }
            }
        }
    }

    vec3 midpoint(const Node& node) const {
        vec3 p;
        p[node.axis] = 0.5f * (node.begin + node.end);
        p[(node.axis + 1) % 3] = lattice_[(node.axis + 1) % 3][node.i];
        p[(node.axis + 2) % 3] = lattice_[(node.axis + 2) % 3][node.j];
        return p;
    }

    void collect(CellRegions& out) {
        float axisWeight[3], weights = 0.0f;
        for (int axis = 0; axis < 3; ++axis) weights += axisWeight[axis] = float(crossings_[axis]) * float(crossings_[axis]);
        const float perLine = h_ * h_ / float(n_ * n_);
        for (float& w : axisWeight) w = weights > 0.0f ? w / weights * perLine : perLine / 3.0f;

        const bool solids = lines_->solids();
        regions_.clear();
        regionOf_.assign(nodes_.size(), -1);
        for (int k = 0; k < int(nodes_.size()); ++k) {
            const int r = root(k);
            if (regionOf_[r] < 0) {
                regionOf_[r] = int(regions_.size());
                regions_.push_back({r});
            }
            Region& region = regions_[regionOf_[r]];
            const Node& node = nodes_[k];
            const float length = node.end - node.begin;
            if (node.fronts() + node.backs() > 0) region.bounded += length;
            region.fronts += length * float(node.fronts() + (solids ? 0 : node.backs()));
            region.backs += solids ? length * float(node.backs()) : 0.0f;
            if (solids && node.backs() == 2) region.enclosed += length;
            region.volume += length * axisWeight[node.axis];
        }
        // The inside of a solid never holds light.
        std::erase_if(regions_, [&](const Region& r) {
            return (solids && r.enclosed > kSolidShare * r.bounded) || !(r.volume > kLeastShare * h_ * h_ * h_);
        });
        std::sort(regions_.begin(), regions_.end(),
                  [](const Region& a, const Region& b) { return a.rank() != b.rank() ? a.rank() > b.rank() : a.root < b.root; });
        if (regions_.size() > kClvMostSlots) regions_.resize(kClvMostSlots);
        std::fill(regionOf_.begin(), regionOf_.end(), -1);
        for (std::size_t r = 0; r < regions_.size(); ++r) regionOf_[regions_[r].root] = int(r);
        for (int k = 0; k < int(nodes_.size()); ++k) regionOf_[k] = regionOf_[root(k)];

        samples_.resize(nodes_.size() * kSteps);
        RegionSample* sample = samples_.data();
        for (int k = 0; k < int(nodes_.size()); ++k) {
            if (regionOf_[k] < 0) continue;
            const Node& node = nodes_[k];
            const float piece = (node.end - node.begin) / float(kSteps);
            vec3 p = midpoint(node);
            for (int step = 0; step < kSteps; ++step) {
                p[node.axis] = node.begin + piece * (float(step) + 0.5f);
                *sample++ = {p, piece * axisWeight[node.axis], regionOf_[k]};
            }
        }
        samples_.resize(std::size_t(sample - samples_.data()));
        faces_.clear();
        for (const Surface& s : surfaces_) faces_.push_back({s.normal, s.position, s.axis, regionOf_[s.below], regionOf_[s.below + 1]});
        const int parts = tree_.grow(faces_, int(regions_.size()), lowest_, samples_, out.splits);
        measure(out, parts);
    }

    // Distance from a position in the cell to the closest point where a line meets a surface, m; at most the cell's side.
    float clearance(const vec3& position) const {
        float nearest[kLanes];
        std::fill(nearest, nearest + kLanes, h_ * h_);
        const float *x = surfaceAt_[0].data(), *y = surfaceAt_[1].data(), *z = surfaceAt_[2].data();
        for (std::size_t first = 0; first < surfaceAt_[0].size(); first += kLanes) {
            for (std::size_t lane = 0; lane < kLanes; ++lane) {
                const float dx = x[first + lane] - position.x, dy = y[first + lane] - position.y, dz = z[first + lane] - position.z;
                const float square = dx * dx + dy * dy + dz * dz;
                nearest[lane] = square < nearest[lane] ? square : nearest[lane];
            }
        }
        for (std::size_t half = kLanes / 2; half > 0; half /= 2) {
            for (std::size_t lane = 0; lane < half; ++lane) nearest[lane] = std::min(nearest[lane], nearest[lane + half]);
        }
        return std::sqrt(nearest[0]);
    }

    // Volume, centroid and inner point of each part, by the samples that the tree sends to it. Parts that got none are dropped.
    void measure(CellRegions& out, int parts) {
        // What pads the last round lies far outside.
        for (int axis = 0; axis < 3; ++axis) {
            surfaceAt_[axis].assign((surfaces_.size() + kLanes - 1) / kLanes * kLanes, 4.0f * h_);
            for (std::size_t k = 0; k < surfaces_.size(); ++k) surfaceAt_[axis][k] = surfaces_[k].position[axis];
        }
        int renumber[kClvMostSlots];
        for (int r = 0; r < parts; ++r) {
            OpenRegion region;
            vec3 moment(0.0f);
            for (const RegionSample& s : samples_) {
                if (s.region == r) region.volume += s.volume, moment += s.position * s.volume;
            }
            renumber[r] = int(out.regions.size());
            if (!(region.volume > 0.0f)) continue;
            region.centroid = moment / region.volume;
            // Of a region that bends around a column, the sample next to the centroid may lie on the column, and see nothing.
            float least = 1e30f, clear = h_;  // clearance at the sample that was looked at last
            vec3 last(0.0f);
            for (const RegionSample& s : samples_) {
                if (s.region != r) continue;
                const float away = length(s.position - region.centroid);
                // Clearance grows by no more than the way from one position to another.
                if (away - std::min(clear + length(s.position - last), h_) >= least) continue;
                clear = clearance(s.position), last = s.position;
                const float cost = away - clear;
                if (cost < least) least = cost, region.inside = s.position;
            }
            region.centroid += lowest_;
            region.inside += lowest_;
            out.regions.push_back(region);
        }
        for (RegionSplit& split : out.splits) {
            if (split.front < 0) split.front = -1 - renumber[-1 - split.front];
            if (split.back < 0) split.back = -1 - renumber[-1 - split.back];
        }
        if (out.regions.size() < 2) out.splits.clear();
    }

    const LineGrid* lines_ = nullptr;
    int n_ = 0;
    ivec3 cell_{0};
    float h_ = 0;
    vec3 lowest_{0.0f};
    int crossings_[3] = {0, 0, 0};
    std::vector<Node> nodes_;
    std::vector<LineEnds> ends_;
    std::vector<Surface> surfaces_;
    std::vector<float> surfaceAt_[3];      // their positions, padded to whole rounds of kLanes
    std::vector<Crossed> crossed_;         // a line each, i fastest, then j, then the axis
    std::vector<float> lattice_[3];        // coordinates of the lattice, m from the lowest corner
    std::vector<int> nodeAt_[3];
    std::vector<Region> regions_;
    std::vector<int> regionOf_;  // a node each, -1: none that is kept
    std::vector<RegionSample> samples_;
    std::vector<RegionFace> faces_;
    RegionTree tree_;
    CellRegions found_;
};

}  // namespace clv
#endif
