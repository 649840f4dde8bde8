// Solids that scenes made here consist of, and a turn of the whole.
#pragma once
#include <functional>
#include <vector>

#include "bindings/scene/scene_builder.h"

namespace clv {

// Solid boxes on a grid of uneven planes: block (i, j, k) fills xs[i]..xs[i+1], ys[j]..ys[j+1], zs[k]..zs[k+1].
struct BlockGrid {
    std::vector<double> xs, ys, zs;  // m, ascending
    std::function<bool(const glm::ivec3& block)> isSolid;
    bool outsideIsSolid = false;     // what surrounds the grid: air, or rock that shows no face of its own
};

// Picks the material of the face between an open block and the solid one beside it.
using FaceMaterial = std::function<std::uint32_t(const glm::ivec3& open, const glm::ivec3& solid)>;

// Adds exactly the faces between solid and open blocks, each facing the open one: neighbours share whole edges and nothing lies
// hidden inside the solid, so that the surface is closed without cracks.
void addBlocks(SceneBuilder& builder, const BlockGrid& grid, const FaceMaterial& material);

// A box with half-axes `x`, `y`, `z` (right-handed, m), its faces outwards.
void addBox(SceneBuilder& builder, const glm::dvec3& center, const glm::dvec3& x, const glm::dvec3& y, const glm::dvec3& z,
            std::uint32_t material);

// A sphere around the origin seen from inside: an icosahedron whose faces were split `levels` times into four, scaled so that its
// area is that of the sphere, 4 pi radius^2.
void addSphereInside(SceneBuilder& builder, double radius, int levels, std::uint32_t material);

// Turns all of a scene around the origin of its positions.
void turnScene(Scene& scene, const glm::dmat3& rotation);

}  // namespace clv
