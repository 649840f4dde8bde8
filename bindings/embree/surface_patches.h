// Which share of all views falls on which part of which surface: a corner of a wide ground can matter more than all the rest of it.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "bindings/scene/scene.h"

namespace clv {

// A place that somebody sees.
struct SurfaceView {
    std::uint32_t triangle = 0;
    glm::vec3 position{0.0f};  // m, on the triangle
};

// A triangle, or a part of it of the same shape: a quarter, a quarter of that, and so on.
struct SurfacePatch {
    std::uint32_t triangle = 0;
    float v1 = 0.0f, v2 = 0.0f;  // barycentric coordinates of its first corner, as those of Scene::albedo
    float size = 1.0f;           // of its edges, as a share of those of the triangle; negative of a part that is upside down
    double area = 0.0;           // m^2
    double share = 0.0;          // of the views; of its area where there are none. All together: 1
};

// Covers each triangle once: whole, or cut where many views fall, up to 2^20 times along an edge. Few views don't tell places from each other:
// shares go down a tree of neighbouring triangles, and of quarters of triangles, whose branches share by area where there are few of them, and
// are never left out altogether (a Polya tree: Ferguson 1974). Neighbours follow each other.
std::vector<SurfacePatch> patchesWhereSeen(const Scene& scene, std::span<const SurfaceView> views);

// m^2, of each triangle.
std::vector<double> triangleAreas(const Scene& scene);

}  // namespace clv
