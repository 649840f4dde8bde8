#include <gtest/gtest.h>

#include "clv/math/octahedral.h"
#include "support/chi_square.h"

namespace clv::test {
namespace {

TEST(Octahedral, directionsComeBackThroughTheSquare) {
    for (uint i = 0; i < 10000; ++i) {
        const vec3 direction = randomDirection(1, i);
        const vec2 square = clvOctahedralFromDirection(direction);
        EXPECT_LE(std::max(std::abs(square.x), std::abs(square.y)), 1.0f);
        EXPECT_LT(glm::length(clvDirectionFromOctahedral(square) - direction), 1e-6f);
    }
}

TEST(Octahedral, pointsOfTheSquareComeBackThroughTheDirection) {
    for (uint i = 0; i < 10000; ++i) {
        const vec2 square(2.0f * randomUnit(2, 2 * i) - 1.0f, 2.0f * randomUnit(2, 2 * i + 1) - 1.0f);
        EXPECT_LT(glm::length(clvOctahedralFromDirection(clvDirectionFromOctahedral(square)) - square), 1e-6f);
    }
}

TEST(Octahedral, directionsOfAnyLengthMapAlike) {
    const vec3 direction = randomDirection(3, 0);
    EXPECT_LT(glm::length(clvOctahedralFromDirection(direction) - clvOctahedralFromDirection(direction * 1e6f)), 1e-6f);
}

TEST(Octahedral, pointsOfTheSquareLandOnTheOctahedron) {
    for (uint i = 0; i < 1000; ++i) {
        const vec3 p = clvOctahedronFromSquare(vec2(2.0f * randomUnit(4, 2 * i) - 1.0f, 2.0f * randomUnit(4, 2 * i + 1) - 1.0f));
        EXPECT_NEAR(std::abs(p.x) + std::abs(p.y) + std::abs(p.z), 1.0f, 3e-7f);
    }
}

TEST(Octahedral, axesLieWhereTheHeaderSays) {
    EXPECT_EQ(clvDirectionFromOctahedral(vec2(0.0f, 0.0f)), vec3(0, 0, 1));
    EXPECT_EQ(clvDirectionFromOctahedral(vec2(1.0f, 0.0f)), vec3(1, 0, 0));
    EXPECT_EQ(clvDirectionFromOctahedral(vec2(0.0f, -1.0f)), vec3(0, -1, 0));
    for (float x : {-1.0f, 1.0f}) {
        for (float y : {-1.0f, 1.0f}) EXPECT_EQ(clvDirectionFromOctahedral(vec2(x, y)), vec3(0, 0, -1));
    }
}

TEST(Octahedral, straightDownWithEitherZeroMapsToACorner) {
    for (float zero : {0.0f, -0.0f}) {
        const vec2 square = clvOctahedralFromDirection(vec3(zero, zero, -1.0f));
        EXPECT_EQ(std::abs(square.x), 1.0f);
        EXPECT_EQ(std::abs(square.y), 1.0f);
    }
}

}  // namespace
}  // namespace clv::test
