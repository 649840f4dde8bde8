// The open regions of a cell that geometry cuts: their volumes, centroids, and the planes that part them.
//
// The lines of a LineGrid are cut into intervals by their crossings with the scene. Intervals that share a lattice point belong
// to one region. Lengths are exact along a line, so a wall that is square to an axis is measured exactly by that axis' lines;
// axes therefore count by the square of the crossings that they saw.
#ifndef CLV_CPU_CELL_REGIONS_H
#define CLV_CPU_CELL_REGIONS_H
#include <algorithm>
#include <vector>

#include "line_grid.h"

namespace clv {

struct OpenRegion {
    float volume = 0.0f;   // m^3
    vec3 centroid{0.0f};   // m, relative to the anchor
    vec3 inside{0.0f};     // a point of the region, near its centroid
};

// A node of the tree of planes that parts a cell. Children below 0 are regions: -1 - region.
struct RegionSplit {
    vec4 plane{0.0f};
    int front = -1, back = -1;
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
        out.cut = false;
        out.regions.clear();
        out.splits.clear();
        for (int axis = 0; axis < 3; ++axis) crossings_[axis] = 0;
        for (int axis = 0; axis < 3; ++axis) {
            for (int j = 0; j < n_; ++j) {
                for (int i = 0; i < n_; ++i) addLine(axis, i, j, out.cut);
            }
        }
        if (!out.cut) {
            if (!solidAround()) out.regions.push_back({h_ * h_ * h_, lowest_ + vec3(0.5f * h_), lowest_ + vec3(0.5f * h_)});
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
        int below, above;      // what the next surface shows, down and up the line: 1 its front, -1 its back, 0 there is none
        int fronts() const { return (below > 0) + (above > 0); }
        int backs() const { return (below < 0) + (above < 0); }
    };
    struct Region {
        int root = -1;
        float length = 0, enclosed = 0;  // m, of all intervals, and of those between two backs
        float volume = 0;                // m^3
        float fronts = 0, backs = 0;     // m, of the intervals that see them
        // How much of the region looks out on front faces. What lies behind the walls of a room sees backs only.
        float openness() const { return fronts > 0.0f ? fronts / (fronts + backs) : 0.0f; }
        float rank() const { return volume * openness() * openness() * openness(); }
    };
    // A short piece of a line in one of the regions.
    struct Sample {
        vec3 position;   // m, from the cell's lowest corner
        float volume;    // m^3, what it stands for
        int region;
    };
    struct LineEnds {
        int first, last;  // nodes
    };
    struct Surface {
        vec3 normal, position;
        int axis, below;  // the line's axis, and the node that ends here; the next node begins here
    };
    // Surface points that look to one side of a plane, and how many of them each region has.
    struct FaceSum {
        vec3 sum{0.0f};
        int count = 0;
        int of[kClvMostSlots] = {};
        void add(int region, const vec3& p) {
            if (region >= 0) sum += p, ++count, ++of[region];
        }
    };
    struct Plane {
        vec3 normal{0.0f};     // sum
        FaceSum facing[2];     // to the front, to the back
        int count = 0;
    };

    // Cosine between surfaces that count as one plane.
    static constexpr float kSamePlane = 0.9f;
    static constexpr std::size_t kMostPlanes = 4;
    // Pieces into which an interval is cut to see on which side of a plane it lies.
    static constexpr int kSteps = 4;
    // Share of a plane's surface that a region must meet, and of the region that must lie on either side, for it to be parted there.
    static constexpr float kEdgeShare = 0.05f;
    // Volume of other regions, over a slot's own, up to which it is left out.
    static constexpr float kMostStray = 0.25f;
    // Share of the impurity that a further plane must remove.
    static constexpr float kLeastGain = 0.02f;

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
        auto hits = lines_->line(axis, cell_, i, j);
        const float begin = lines_->cellBegin(axis, cell_);
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
            const int below = hit == hits.begin() ? 0 : std::prev(hit)->front ? -1 : 1;
            const int above = hit == hits.end() ? 0 : hit->front ? 1 : -1;
            const int node = int(nodes_.size());
            nodes_.push_back({node, axis, i, j, from, to, below, above});
            for (; k < n_ && (atEnd || lines_->latticeOffset(axis, k) * h_ < to); ++k) nodeAt(axis, latticePoint(axis, k, i, j)) = node;
            if (atEnd) break;
            crossings_[axis]++;
            vec3 position(0.0f);  // from the lowest corner
            position[axis] += to;
            position[(axis + 1) % 3] += h_ * lines_->latticeOffset((axis + 1) % 3, i);
            position[(axis + 2) % 3] += h_ * lines_->latticeOffset((axis + 2) % 3, j);
            surfaces_.push_back({hit->normal, position, axis, node});
            from = to;
        }
        ends.last = int(nodes_.size()) - 1;
        ends_.push_back(ends);
    }

    bool solidAround() const {
        return std::all_of(nodes_.begin(), nodes_.end(), [](const Node& node) { return node.backs() == 2; });
    }

    bool holdsLattice(const Node& node) const {
        for (int k = 0; k < n_; ++k) {
            float p = lines_->latticeOffset(node.axis, k) * h_;
            if (p >= node.begin && p < node.end) return true;
        }
        return false;
    }

    void connect() {
        for (std::size_t p = 0; p < nodeAt_[0].size(); ++p) {
            unite(nodeAt_[0][p], nodeAt_[1][p]);
            unite(nodeAt_[0][p], nodeAt_[2][p]);
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
        p[(node.axis + 1) % 3] = h_ * lines_->latticeOffset((node.axis + 1) % 3, node.i);
        p[(node.axis + 2) % 3] = h_ * lines_->latticeOffset((node.axis + 2) % 3, node.j);
        return p;
    }

    void collect(CellRegions& out) {
        float axisWeight[3], weights = 0.0f;
        for (int axis = 0; axis < 3; ++axis) weights += axisWeight[axis] = float(crossings_[axis]) * float(crossings_[axis]);
        const float perLine = h_ * h_ / float(n_ * n_);
        for (float& w : axisWeight) w = weights > 0.0f ? w / weights * perLine : perLine / 3.0f;

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
            region.length += length;
            region.fronts += length * float(node.fronts());
            region.backs += length * float(node.backs());
            if (node.backs() == 2) region.enclosed += length;
            region.volume += length * axisWeight[node.axis];
        }
        // The inside of a solid never holds light.
        std::erase_if(regions_, [&](const Region& r) {
            return r.enclosed > kSolidShare * r.length || !(r.volume > kLeastShare * h_ * h_ * h_);
        });
        std::sort(regions_.begin(), regions_.end(),
                  [](const Region& a, const Region& b) { return a.rank() != b.rank() ? a.rank() > b.rank() : a.root < b.root; });
        if (regions_.size() > kClvMostSlots) regions_.resize(kClvMostSlots);
        std::fill(regionOf_.begin(), regionOf_.end(), -1);
        for (std::size_t r = 0; r < regions_.size(); ++r) regionOf_[regions_[r].root] = int(r);
        for (int k = 0; k < int(nodes_.size()); ++k) regionOf_[k] = regionOf_[root(k)];

        samples_.clear();
        for (int k = 0; k < int(nodes_.size()); ++k) {
            if (regionOf_[k] < 0) continue;
            const Node& node = nodes_[k];
            const float piece = (node.end - node.begin) / float(kSteps);
            vec3 p = midpoint(node);
            for (int step = 0; step < kSteps; ++step) {
                p[node.axis] = node.begin + piece * (float(step) + 0.5f);
                samples_.push_back({p, piece * axisWeight[node.axis], regionOf_[k]});
            }
        }
        gatherPlanes();
        partAroundEdges();
        if (regions_.size() > 1) growTree(out, 0, samples_.size(), 0);
        measure(out);
    }

    // The surfaces that lie between open regions, or inside one, as planes: surfaces of about one direction make one plane, so the
    // two faces of a thin wall give the plane in its middle.
    void gatherPlanes() {
        planes_.clear();
        for (const Surface& s : surfaces_) {
            const int below = regionOf_[s.below], above = regionOf_[s.below + 1];
            if (below < 0 && above < 0) continue;
            Plane* match = nullptr;
            for (Plane& plane : planes_) {
                if (std::abs(dot(glm::normalize(plane.normal), s.normal)) > kSamePlane) match = &plane;
            }
            if (!match) {
                planes_.push_back({});
                match = &planes_.back();
                match->normal = s.normal;
            } else {
                match->normal += dot(match->normal, s.normal) < 0.0f ? -s.normal : s.normal;
            }
            const bool upwards = match->normal[s.axis] > 0.0f;  // along the axis means to the plane's front
            match->facing[0].add(upwards ? above : below, s.position);
            match->facing[1].add(upwards ? below : above, s.position);
            match->count++;
        }
        // Insertion keeps the order of equals, and needs no memory as std::stable_sort does.
        for (std::size_t i = 1; i < planes_.size(); ++i) {
            for (std::size_t k = i; k > 0 && planes_[k].count > planes_[k - 1].count; --k) std::swap(planes_[k], planes_[k - 1]);
        }
        if (planes_.size() > kMostPlanes) planes_.resize(kMostPlanes);
    }

    // Offset half-way between the faces that look to the plane's front and those that look to its back.
    vec4 planeEquation(const Plane& plane) const {
        const vec3 normal = glm::normalize(plane.normal);
        float offset = 0.0f;
        int faces = 0;
        for (const FaceSum& face : plane.facing) {
            if (face.count > 0) offset += dot(normal, face.sum) / float(face.count), ++faces;
        }
        return vec4(normal, offset / float(std::max(faces, 1)));
    }

    // A region that reaches around an edge, be it of a sheet, of a thin wall or of a block, is parted by the planes of the surfaces that it
    // meets there: light behind a surface's plane cannot reach the surface.
    void partAroundEdges() {
        for (const Plane& plane : planes_) {
            const vec4 equation = planeEquation(plane);
            const int count = int(regions_.size());
            for (int r = 0; r < count && regions_.size() < kClvMostSlots; ++r) {
                if (kEdgeShare * float(plane.count) > float(plane.facing[0].of[r] + plane.facing[1].of[r])) continue;
                float front = 0.0f, back = 0.0f;
                for (const Sample& s : samples_) {
                    if (s.region == r) (dot(vec3(equation), s.position) > equation.w ? front : back) += s.volume;
                }
                if (std::min(front, back) < kEdgeShare * (front + back)) continue;
                const int other = int(regions_.size());
                for (Sample& s : samples_) {
                    if (s.region == r && dot(vec3(equation), s.position) <= equation.w) s.region = other;
                }
                regions_.push_back(regions_[r]);
            }
        }
    }

    // How mixed samples are, m^3: the volume times the chance that two of them belong to different regions.
    struct Mixture {
        float volume[kClvMostSlots] = {};
        float impurity() const {
            float sum = 0.0f, squares = 0.0f;
            for (float v : volume) sum += v, squares += v * v;
            return sum > 0.0f ? sum - squares / sum : 0.0f;
        }
        int largest() const { return int(std::max_element(volume, volume + kClvMostSlots) - volume); }
    };

    // A decision tree over samples [first, last): each node takes the plane that leaves the two sides purest. Returns the child's index
    // as RegionSplit has it.
    int growTree(CellRegions& out, std::size_t first, std::size_t last, int depth) {
        Mixture all;
        for (std::size_t k = first; k < last; ++k) all.volume[samples_[k].region] += samples_[k].volume;
        const float before = all.impurity();
        int best = -1;
        float least = before * (1.0f - kLeastGain);
        if (depth < kClvMostSplits && before > 0.0f) {
            for (int p = 0; p < int(planes_.size()); ++p) {
                const vec4 equation = planeEquation(planes_[p]);
                Mixture side[2];
                for (std::size_t k = first; k < last; ++k) {
                    const Sample& s = samples_[k];
                    side[dot(vec3(equation), s.position) > equation.w ? 0 : 1].volume[s.region] += s.volume;
                }
                const float impurity = side[0].impurity() + side[1].impurity();
                if (impurity < least) least = impurity, best = p;
            }
        }
        if (best < 0) {
            // Deposits go where the tree sends them, so what the planes leave of this region elsewhere counts here. A little of another
            // region, as behind a curved wall, is left out: mostly it is dark there. More of it is counted, lest a slot of next to no
            // volume take in the light of a large one.
            const int region = all.largest();
            const int origin = regions_[region].root;
            float own = 0.0f, other = 0.0f;
            for (std::size_t k = first; k < last; ++k) (regions_[samples_[k].region].root == origin ? own : other) += samples_[k].volume;
            for (std::size_t k = first; k < last; ++k) {
                const bool stray = regions_[samples_[k].region].root != origin && other < kMostStray * own;
                samples_[k].region = stray ? -1 : region;
            }
            return -1 - region;
        }
        const vec4 equation = planeEquation(planes_[best]);
        const std::size_t half = partition(first, last, equation);
        const std::size_t node = out.splits.size();
        out.splits.push_back({vec4(vec3(equation), equation.w + dot(vec3(equation), lowest_)), 0, 0});
        const int front = growTree(out, first, half, depth + 1);
        const int back = growTree(out, half, last, depth + 1);
        out.splits[node].front = front;
        out.splits[node].back = back;
        return int(node);
    }

    // Moves samples in front of the plane before the others, each kind in its order; returns where the others begin.
    std::size_t partition(std::size_t first, std::size_t last, const vec4& equation) {
        behind_.clear();
        std::size_t half = first;
        for (std::size_t k = first; k < last; ++k) {
            const Sample s = samples_[k];
            if (dot(vec3(equation), s.position) > equation.w) samples_[half++] = s;
            else behind_.push_back(s);
        }
        std::copy(behind_.begin(), behind_.end(), samples_.begin() + half);
        return half;
    }

    // Volume, centroid and inner point of each region, by the samples that the tree sends to it. Regions that got none are dropped.
    void measure(CellRegions& out) {
        int renumber[kClvMostSlots];
        for (int r = 0; r < int(regions_.size()); ++r) {
            OpenRegion region;
            vec3 moment(0.0f);
            for (const Sample& s : samples_) {
                if (s.region == r) region.volume += s.volume, moment += s.position * s.volume;
            }
            renumber[r] = int(out.regions.size());
            if (!(region.volume > 0.0f)) continue;
            region.centroid = moment / region.volume;
            float nearest = 1e30f;
            for (const Sample& s : samples_) {
                const vec3 d = s.position - region.centroid;
                if (s.region == r && dot(d, d) < nearest) nearest = dot(d, d), region.inside = s.position;
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
    std::vector<int> nodeAt_[3];
    std::vector<Region> regions_;
    std::vector<int> regionOf_;  // a node each, -1: none that is kept
    std::vector<Sample> samples_;
    std::vector<Sample> behind_;
    std::vector<Plane> planes_;
    CellRegions found_;
};

}  // namespace clv
#endif
