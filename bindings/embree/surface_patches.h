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
    float area = 0.0f;           // m^2
    float share = 0.0f;          // of the views, smoothed by area. All together: 1
};

// Covers each triangle once: whole, or cut where many views fall, into up to 2^20 parts an edge. Few views don't tell places from each other:
// shares go down a tree of neighbouring triangles of like size, and of quarters of triangles, whose branches share by area where there are few
// views, and are never left out altogether (a Polya tree: Ferguson 1974). Without views the patches are all triangles in their order.
std::vector<SurfacePatch> patchesWhereSeen(const Scene& scene, std::span<const SurfaceView> views);

}  // namespace clv
