// The scene as a tree of boxes that a shader can walk, made by Embree's builder.
#pragma once
#include <vector>

#include "bindings/scene/scene.h"
#include "clv/data/bvh.h"

namespace clv {

// Rows as data/bvh.h says.
struct Bvh {
    std::vector<vec4> boxes;
    std::vector<uvec4> children;
    std::vector<vec4> triangles;  // in the order of the leaves
};

// The same scene gives the same tree, on any number of threads. Triangles without area or with a corner that is not finite, which no
// ray can meet, are left out. Throws std::runtime_error with one line when Embree cannot build it within kClvBvhStack.
Bvh buildBvh(const Scene& scene);

}  // namespace clv
