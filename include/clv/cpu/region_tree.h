// How a cell is parted into its open regions: a tree of planes, fitted to the surfaces that lie between them.
#ifndef CLV_CPU_REGION_TREE_H
#define CLV_CPU_REGION_TREE_H
#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

#include "../data/light_volume.h"

namespace clv {

// A node of the tree of planes that parts a cell. Children below 0 are regions: -1 - region.
struct RegionSplit {
    vec4 plane{0.0f};
    int front = -1, back = -1;
};

// A short piece of a line in one of the regions.
struct RegionSample {
    vec3 position;   // m, from the cell's lowest corner
    float volume;    // m^3, what it stands for
    int region;      // -1: none
};

// A point where a line along an axis meets a surface.
struct RegionFace {
    vec3 normal, position;  // unit length; m, from the cell's lowest corner
    int axis;
    int below, above;       // regions before and behind it on the line, -1: none
};

// Grows one tree after another; keeps its memory.
class RegionTree {
public:
    // Parts samples of `regions` regions. Each sample's region becomes the part that the tree sends it to, or -1 where it is left out.
    // Returns the number of parts, some of which may have no sample. Without splits, all is one part.
    int grow(std::span<const RegionFace> faces, int regions, const vec3& lowestCorner, std::span<RegionSample> samples,
             std::vector<RegionSplit>& splits) {
        lowest_ = lowestCorner;
        origins_.resize(regions);
        std::iota(origins_.begin(), origins_.end(), 0);
        gatherPlanes(faces);
        partAroundEdges(samples);
        if (origins_.size() > 1) growNode(samples, splits, 0, samples.size(), 0);
        return int(origins_.size());
    }

private:
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
    // Share of a plane's surface that a region must meet, and of the region that must lie on either side, for it to be parted there.
    static constexpr float kEdgeShare = 0.05f;
    // Volume of other regions, over a slot's own, up to which it is left out.
    static constexpr float kMostStray = 0.25f;
    // Share of the impurity that a further plane must remove.
    static constexpr float kLeastGain = 0.02f;

    // The surfaces that lie between open regions, or inside one, as planes: surfaces of about one direction make one plane, so the
    // two faces of a thin wall give the plane in its middle.
    void gatherPlanes(std::span<const RegionFace> faces) {
        planes_.clear();
        for (const RegionFace& s : faces) {
            if (s.below < 0 && s.above < 0) continue;
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
            match->facing[0].add(upwards ? s.above : s.below, s.position);
            match->facing[1].add(upwards ? s.below : s.above, s.position);
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
    void partAroundEdges(std::span<RegionSample> samples) {
        for (const Plane& plane : planes_) {
            const vec4 equation = planeEquation(plane);
            const int count = int(origins_.size());
            for (int r = 0; r < count && origins_.size() < kClvMostSlots; ++r) {
                if (kEdgeShare * float(plane.count) > float(plane.facing[0].of[r] + plane.facing[1].of[r])) continue;
                float front = 0.0f, back = 0.0f;
                for (const RegionSample& s : samples) {
                    if (s.region == r) (dot(vec3(equation), s.position) > equation.w ? front : back) += s.volume;
                }
                if (std::min(front, back) < kEdgeShare * (front + back)) continue;
                const int other = int(origins_.size());
                for (RegionSample& s : samples) {
                    if (s.region == r && dot(vec3(equation), s.position) <= equation.w) s.region = other;
                }
                origins_.push_back(origins_[r]);
            }
        }
    }

    // How mixed samples are, m^3: the volume times the chance that two of them belong to different regions.
    struct Mixture {
        float volume[kClvMostSlots] = {};
        float impurity() const {
            // The square of the volume of a tiny or a huge cell is no float.
            double sum = 0.0, squares = 0.0;
            for (float v : volume) sum += v, squares += double(v) * v;
            return sum > 0.0 ? float(sum - squares / sum) : 0.0f;
        }
        int largest() const { return int(std::max_element(volume, volume + kClvMostSlots) - volume); }
    };

    // A decision tree over samples [first, last): each node takes the plane that leaves the two sides purest. Returns the child's index
    // as RegionSplit has it.
    int growNode(std::span<RegionSample> samples, std::vector<RegionSplit>& splits, std::size_t first, std::size_t last, int depth) {
        Mixture all;
        for (std::size_t k = first; k < last; ++k) all.volume[samples[k].region] += samples[k].volume;
        const float before = all.impurity();
        int best = -1;
        float least = before * (1.0f - kLeastGain);
        if (depth < kClvMostSplits && before > 0.0f) {
            for (int p = 0; p < int(planes_.size()); ++p) {
                const vec4 equation = planeEquation(planes_[p]);
                Mixture side[2];
                for (std::size_t k = first; k < last; ++k) {
                    const RegionSample& s = samples[k];
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
            const int origin = origins_[region];
            float own = 0.0f, other = 0.0f;
            for (std::size_t k = first; k < last; ++k) (origins_[samples[k].region] == origin ? own : other) += samples[k].volume;
            for (std::size_t k = first; k < last; ++k) {
                const bool stray = origins_[samples[k].region] != origin && other < kMostStray * own;
                samples[k].region = stray ? -1 : region;
            }
            return -1 - region;
        }
        const vec4 equation = planeEquation(planes_[best]);
        const std::size_t half = partition(samples, first, last, equation);
        const std::size_t node = splits.size();
        splits.push_back({vec4(vec3(equation), equation.w + dot(vec3(equation), lowest_)), 0, 0});
        const int front = growNode(samples, splits, first, half, depth + 1);
        const int back = growNode(samples, splits, half, last, depth + 1);
        splits[node].front = front;
        splits[node].back = back;
        return int(node);
    }

    // Moves samples in front of the plane before the others, each kind in its order; returns where the others begin.
    std::size_t partition(std::span<RegionSample> samples, std::size_t first, std::size_t last, const vec4& equation) {
        behind_.clear();
        std::size_t half = first;
        for (std::size_t k = first; k < last; ++k) {
            const RegionSample s = samples[k];
            if (dot(vec3(equation), s.position) > equation.w) samples[half++] = s;
            else behind_.push_back(s);
        }
        std::copy(behind_.begin(), behind_.end(), samples.begin() + half);
        return half;
    }

    vec3 lowest_{0.0f};
    std::vector<int> origins_;  // a part each: the region that it was cut from
    std::vector<Plane> planes_;
    std::vector<RegionSample> behind_;
};

}  // namespace clv
#endif
