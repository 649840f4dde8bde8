// What lies under the mouse, or at a typed position.
#pragma once
#include <optional>
#include <string>

#include "viz/view.h"
#include "viz/world.h"

namespace clv {

// A line of sight.
struct Sight {
    vec3 origin;     // m, relative to the anchor
    vec3 direction;  // unit length
};

struct Pick {
    vec3 position;                 // m, relative to the anchor
    std::optional<vec3> normal{};  // of a surface, on the side that was looked at
    std::optional<std::size_t> slice{};  // index of the plane that was hit
    ShownCascade cascade{};              // of the cell that is meant; none: the finest there
};

// x,y,z or x,y,z,nx,ny,nz, world space; a place without a normal is one in the cascade that is shown.
Pick typedPick(const std::vector<double>& numbers, const BakedVolume& volume, ShownCascade shown);

// The nearest of what the view shows: a cell's cube, a slice, a surface. `world` may be null.
std::optional<Pick> pickAlong(const BakedVolume& volume, const World* world, const View& view, const Sight& sight, const ParallelFor& parallelFor);

// The cell that a pick is of; on a surface the one in front of it, not the one behind.
std::optional<ShownCell> pickedCell(const BakedVolume& volume, const Pick& pick);
// The place in that cell that was picked, m.
vec3 placeInCell(const BakedVolume& volume, const Pick& pick);

// Where a plane across `axis` through `grabbed` goes so that it stays under the mouse, m, relative to the anchor: the point of the axis
// through `grabbed` that is nearest to the line of sight. Stays where it is for a line of sight along the axis.
float draggedPlace(const vec3& grabbed, int axis, const Sight& sight);

// Where a thing goes that keeps its distance from the screen, whose plane has this normal.
vec3 draggedPosition(const vec3& grabbed, const vec3& screenNormal, const Sight& sight);

}  // namespace clv
