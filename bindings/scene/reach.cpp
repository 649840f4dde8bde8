#include "bindings/scene/reach.h"

#include <cmath>

#include <fmt/format.h>

#include "bindings/scene/scene.h"

namespace clv {

bool isWithinReach(const glm::dvec3& p) {
    return std::abs(p.x) <= kFarthestCoordinate && std::abs(p.y) <= kFarthestCoordinate && std::abs(p.z) <= kFarthestCoordinate;
}

void checkReach(const glm::dvec3& positionWorld, const std::string& place) {
    for (int axis = 0; axis < 3; ++axis)
        // Negated, so that what is not a number is refused too.
        if (!(std::abs(positionWorld[axis]) <= kFarthestCoordinate))
            throw InputError(fmt::format("{}: expected coordinates of at most {:g} m, found {:g}", place, kFarthestCoordinate, positionWorld[axis]));
}

}  // namespace clv
