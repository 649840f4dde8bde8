#include "bindings/scene/reach.h"

#include <cmath>

#include <fmt/format.h>

#include "bindings/scene/scene.h"

namespace clv {

namespace {

// Also false of what is not a number.
bool isWithinReach(double coordinate) { return std::abs(coordinate) <= kFarthestCoordinate; }

}  // namespace

bool isWithinReach(const glm::dvec3& p) { return isWithinReach(p.x) && isWithinReach(p.y) && isWithinReach(p.z); }

void checkReach(const glm::dvec3& positionWorld, const std::string& place) {
    for (int axis = 0; axis < 3; ++axis)
        if (!isWithinReach(positionWorld[axis]))
            throw InputError(fmt::format("{}: expected coordinates of at most {:g} m, found {:g}", place, kFarthestCoordinate, positionWorld[axis]));
}

}  // namespace clv
