#include "bindings/embree/surface_patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "bindings/embree/seen_faces.h"

namespace clv {
namespace {

constexpr std::size_t kFewViews = 16;      // that are shared by area
constexpr double kPrior = 4.0;             // views that are shared by area beside those that there are
constexpr double kLikeSizes = 16.0;        // areas of triangles that share as neighbours
constexpr float kSmallest = 0x1p-20f;      // part of an edge: corners of patches are floats without rounding

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
    part.size = which == 3 ? -half : half, part.area = 0.25 * patch.area;
    if (which == 1 || which == 3) part.v1 += half;
    if (which == 2 || which == 3) part.v2 += half;
    return part;
}

// Of what falls on the whole.
double shareOf(std::size_t views, double area, std::size_t wholeViews, double wholeArea) {
    const double byArea = wholeArea > 0.0 ? area / wholeArea : 0.0;
    return wholeViews < kFewViews ? byArea : (double(views) + kPrior * byArea) / (double(wholeViews) + kPrior);
}

class Sharing {
public:
    Sharing(const Scene& scene, std::span<const SurfaceView> views) : scene_(scene), areas_(triangleAreas(scene)), begins_(scene.triangles.size() + 1, 0) {
        for (const SurfaceView& view : views) ++begins_[view.triangle + 1];
        std::inclusive_scan(begins_.begin(), begins_.end(), begins_.begin());
        places_.resize(views.size());
        std::vector<std::size_t> at(begins_.begin(), begins_.end() - 1);
        for (const SurfaceView& view : views) places_[at[view.triangle]++] = barycentricOf(scene, view);
    }

    std::vector<SurfacePatch> patches() {
        std::vector<std::uint32_t> triangles(scene_.triangles.size());
        std::iota(triangles.begin(), triangles.end(), 0u);
        patches_.reserve(triangles.size());
        share(triangles, viewsOf(triangles), areaOf(triangles), 1.0);
        return std::move(patches_);
    }

private:
    // Shares out among triangles that lie together.
    void share(std::span<std::uint32_t> triangles, std::size_t views, double area, double whole) {
        if (views < kFewViews) {
            for (const std::uint32_t t : triangles) patches_.push_back({.triangle = t, .area = areas_[t], .share = whole * shareOf(0, areas_[t], 0, area)});
        } else if (triangles.size() == 1) {
            const std::uint32_t t = triangles[0];
            cut({.triangle = t, .area = areas_[t], .share = whole}, {places_.begin() + std::ptrdiff_t(begins_[t]), places_.begin() + std::ptrdiff_t(begins_[t + 1])});
        } else {
            const auto middle = halve(triangles);
            for (const std::span half : {std::span(triangles.begin(), middle), std::span(middle, triangles.end())}) {
                const std::size_t seen = viewsOf(half);
                const double part = areaOf(half);
                share(half, seen, part, whole * shareOf(seen, part, views, area));
            }
        }
    }

    // Into large and small ones where they are of many sizes: a small one, beside a large one, would have nothing by area. Else by place.
    std::span<std::uint32_t>::iterator halve(std::span<std::uint32_t> triangles) const {
        const auto area = [&](std::uint32_t t) { return areas_[t]; };
        const auto [least, most] = std::ranges::minmax(triangles, {}, area);
        if (areas_[most] > kLikeSizes * areas_[least]) {
            const double between = std::sqrt(areas_[least]) * std::sqrt(areas_[most]);
            return std::ranges::partition(triangles, [&](std::uint32_t t) { return areas_[t] <= between; }).begin();
        }
        const auto middle = triangles.begin() + std::ptrdiff_t(triangles.size() / 2);
        const int axis = longestAxis(triangles);
        std::ranges::nth_element(triangles, middle, {}, [&](std::uint32_t t) { return std::pair(placeAlong(axis, t), t); });
        return middle;
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
            part.share = patch.share * shareOf(std::size_t(end - rest), 0.25, places.size(), 1.0);
            cut(part, {rest, end});
            rest = end;
        }
    }

    std::size_t viewsOf(std::span<const std::uint32_t> triangles) const {
        std::size_t sum = 0;
        for (const std::uint32_t t : triangles) sum += begins_[t + 1] - begins_[t];
        return sum;
    }
    double areaOf(std::span<const std::uint32_t> triangles) const {
        double sum = 0.0;
        for (const std::uint32_t t : triangles) sum += areas_[t];
        return sum;
    }
    // Three times the centroid's coordinate.
    float placeAlong(int axis, std::uint32_t t) const {
        const glm::uvec3& c = scene_.triangles[t];
        return scene_.positions[c.x][axis] + scene_.positions[c.y][axis] + scene_.positions[c.z][axis];
    }
    int longestAxis(std::span<const std::uint32_t> triangles) const {
        std::array<float, 3> extents{};
        for (int axis = 0; axis < 3; ++axis) {
            const auto [lo, hi] = std::ranges::minmax(triangles, {}, [&](std::uint32_t t) { return placeAlong(axis, t); });
            extents[std::size_t(axis)] = placeAlong(axis, hi) - placeAlong(axis, lo);
        }
        return int(std::ranges::max_element(extents) - extents.begin());
    }

    const Scene& scene_;
    std::vector<double> areas_;          // m^2
    std::vector<std::size_t> begins_;    // of each triangle's places
    std::vector<Barycentric> places_;
    std::vector<SurfacePatch> patches_;
};

}  // namespace

std::vector<double> triangleAreas(const Scene& scene) {
    std::vector<double> areas(scene.triangles.size());
    for (std::size_t t = 0; t < areas.size(); ++t) areas[t] = 0.5 * double(glm::length(windingNormal(scene, std::uint32_t(t))));
    return areas;
}

std::vector<SurfacePatch> patchesWhereSeen(const Scene& scene, std::span<const SurfaceView> views) { return Sharing(scene, views).patches(); }

}  // namespace clv
