#include "bindings/embree/surface_patches.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bindings/embree/seen_faces.h"

namespace clv {
namespace {

constexpr std::uint32_t kFewViews = 16;    // below which all is shared by area
constexpr double kPrior = 4.0;             // views that each branching adds, shared by area
constexpr float kLikeSizes = 16.0f;        // largest ratio of areas up to which triangles are halved by place
constexpr float kSmallest = 0x1p-20f;      // part of an edge: corners of patches are floats without rounding

struct Leaf {
    vec3 place;  // three times the centroid
    float area;  // m^2
    std::uint32_t triangle, views;
};
using Leaves = std::span<Leaf>;

// What lies on a branch.
struct Load {
    std::uint32_t views = 0;
    double area = 0.0;

    explicit Load(std::span<const Leaf> leaves) {
        for (const Leaf& leaf : leaves) views += leaf.views, area += double(leaf.area);
    }
    Load(std::size_t v, double a) : views(std::uint32_t(v)), area(a) {}
    // Of what falls on the whole.
    double shareOf(const Load& whole) const {
        const double byArea = whole.area > 0.0 ? area / whole.area : 0.0;
        return whole.views < kFewViews ? byArea : (double(views) + kPrior * byArea) / (double(whole.views) + kPrior);
    }
};

int longestAxis(std::span<const Leaf> leaves) {
    vec3 lo = leaves[0].place, hi = lo;
    for (const Leaf& leaf : leaves) lo = glm::min(lo, leaf.place), hi = glm::max(hi, leaf.place);
    const vec3 extent = hi - lo;
    return extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
}

// Into large and small ones where they are of many sizes: a small one, beside a large one, would have nothing by area. Else by place. Gives the
// first of the second half.
Leaves::iterator halve(Leaves leaves) {
    const auto [least, most] = std::ranges::minmax(leaves, {}, &Leaf::area);
    if (most.area > kLikeSizes * least.area) {
        const float between = std::sqrt(least.area) * std::sqrt(most.area);
        return std::partition(leaves.begin(), leaves.end(), [&](const Leaf& leaf) { return leaf.area <= between; });
    }
    const auto middle = leaves.begin() + std::ptrdiff_t(leaves.size() / 2);
    std::ranges::nth_element(leaves, middle, {}, [axis = longestAxis(leaves)](const Leaf& leaf) { return std::pair(leaf.place[axis], leaf.triangle); });
    return middle;
}

// Of a view, in its triangle.
struct Barycentric {
    float v1, v2;
};

Barycentric barycentricOf(const Scene& scene, const SurfaceView& view) {
    const glm::uvec3& c = scene.triangles[view.triangle];
    const glm::dvec3 a(scene.positions[c.x]), b = glm::dvec3(scene.positions[c.y]) - a, d = glm::dvec3(scene.positions[c.z]) - a;
    const glm::dvec3 at = glm::dvec3(view.position) - a, normal = glm::cross(b, d);
    const double square = glm::dot(normal, normal);
    return {float(glm::dot(glm::cross(at, d), normal) / square), float(glm::dot(glm::cross(b, at), normal) / square)};
}

// Which quarter of a patch a place lies in: at its three corners, or upside down between them. A place beside the patch belongs to one of them.
int quarterOf(const SurfacePatch& patch, const Barycentric& place) {
    const float w1 = (place.v1 - patch.v1) / patch.size, w2 = (place.v2 - patch.v2) / patch.size;
    return w1 >= 0.5f ? 1 : w2 >= 0.5f ? 2 : w1 + w2 > 0.5f ? 3 : 0;
}

SurfacePatch quarter(const SurfacePatch& patch, int which) {
    SurfacePatch part = patch;
    const float half = 0.5f * patch.size;
    part.size = which == 3 ? -half : half, part.area = 0.25f * patch.area;
    if (which == 1 || which == 3) part.v1 += half;
    if (which == 2 || which == 3) part.v2 += half;
    return part;
}

class Sharing {
public:
    Sharing(const Scene& scene, std::span<const SurfaceView> views) : begins_(scene.triangles.size() + 1, 0), places_(views.size()) {
        for (const SurfaceView& view : views) ++begins_[view.triangle + 1];
        std::inclusive_scan(begins_.begin(), begins_.end(), begins_.begin());
        std::vector<std::uint32_t> at(begins_.begin(), begins_.end() - 1);
        for (const SurfaceView& view : views) places_[at[view.triangle]++] = barycentricOf(scene, view);
        std::vector<Leaf> leaves(scene.triangles.size());
        for (std::uint32_t t = 0; t < leaves.size(); ++t) {
            const glm::uvec3& c = scene.triangles[t];
            leaves[t] = {scene.positions[c.x] + scene.positions[c.y] + scene.positions[c.z], 0.5f * glm::length(windingNormal(scene, t)), t, begins_[t + 1] - begins_[t]};
        }
        patches_.reserve(leaves.size());
        share(leaves, Load(leaves), 1.0);
    }

    std::vector<SurfacePatch> take() { return std::move(patches_); }

private:
    // Shares out among triangles that lie together.
    void share(Leaves leaves, const Load& load, double whole) {
        if (load.views < kFewViews) {
            std::ranges::sort(leaves, {}, &Leaf::triangle);  // halving shuffles them; samples are stratified along a mesh's own order
            for (const Leaf& leaf : leaves) patches_.push_back({.triangle = leaf.triangle, .area = leaf.area, .share = float(whole * Load(0, double(leaf.area)).shareOf(load))});
        } else if (leaves.size() == 1) {
            const std::uint32_t t = leaves[0].triangle;
            cut({.triangle = t, .area = leaves[0].area, .share = float(whole)}, std::span(places_).subspan(begins_[t], load.views));
        } else {
            const auto middle = halve(leaves);
            for (const Leaves half : {Leaves(leaves.begin(), middle), Leaves(middle, leaves.end())}) {
                const Load part(half);
                share(half, part, whole * part.shareOf(load));
            }
        }
    }

    // Shares out among parts of one triangle.
    void cut(const SurfacePatch& patch, std::span<Barycentric> places) {
        if (places.size() < kFewViews || std::abs(patch.size) <= kSmallest) {
            patches_.push_back(patch);
            return;
        }
        auto rest = places.begin();
        for (int which = 0; which < 4; ++which) {
            const auto end = std::partition(rest, places.end(), [&](const Barycentric& place) { return quarterOf(patch, place) == which; });
            SurfacePatch part = quarter(patch, which);
            part.share = float(double(patch.share) * Load(std::size_t(end - rest), 0.25).shareOf(Load(places.size(), 1.0)));
            cut(part, {rest, end});
            rest = end;
        }
    }

    std::vector<std::uint32_t> begins_;  // of each triangle's places
    std::vector<Barycentric> places_;
    std::vector<SurfacePatch> patches_;
};

}  // namespace

std::vector<SurfacePatch> patchesWhereSeen(const Scene& scene, std::span<const SurfaceView> views) { return Sharing(scene, views).take(); }

}  // namespace clv
