// How far away things may lie and how large a scene may be: light is computed in floats, which must hold the squares of areas and distances.
#pragma once
#include <string>

#include <glm/glm.hpp>

namespace clv {

constexpr double kFarthestCoordinate = 1e12;  // m, world space
constexpr double kWidestScene = 1e9;          // m, along each axis

// False for a position beyond kFarthestCoordinate, or not of numbers.
bool isWithinReach(const glm::dvec3& positionWorld);

// Throws InputError, beginning with `place`, for a position beyond kFarthestCoordinate or not of numbers.
void checkReach(const glm::dvec3& positionWorld, const std::string& place);

}  // namespace clv
