// Cells keep directions along the axes that most surfaces face.
#include "clv/plan/direction_frame.h"

#include <gtest/gtest.h>

#include "clv/math/sampling.h"
#include "support/chi_square.h"
#include "support/rotation.h"

namespace clv {
namespace {

// The six faces of a room, 4 x 3 x 5 m, turned.
std::vector<vec3> room(const mat3& rotation) {
    std::vector<vec3> faces;
    for (const vec3& face : {vec3(15, 0, 0), vec3(0, 20, 0), vec3(0, 0, 12)}) {
        for (float side : {-1.0f, 1.0f}) faces.push_back(rotation * (face * side));
    }
    return faces;
}

// Surfaces of all directions, `area` m^2 together.
std::vector<vec3> clutter(float area) {
    std::vector<vec3> faces;
    constexpr uint kCount = 20000;
    for (uint i = 0; i < kCount; ++i) faces.push_back(test::randomDirection(11u, i) * (area / float(kCount)));
    return faces;
}

// Cosine between a direction and the axis of the frame that is closest to it.
float closestAxis(const mat3& frame, const vec3& direction) {
    const vec3 along = abs(frame * direction);
    return std::max(along.x, std::max(along.y, along.z));
}

void expectOrthonormal(const mat3& frame) {
    const mat3 product = frame * glm::transpose(frame);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) EXPECT_NEAR(product[i][j], i == j ? 1.0f : 0.0f, 1e-5f);
}

TEST(DirectionFrame, isTheGridsWhereRoomsAreSquareToIt) {
    EXPECT_EQ(directionFrame(room(mat3(1.0f))), mat3(1.0f));
}

TEST(DirectionFrame, liesAlongTheWallsOfATurnedRoom) {
    for (uint i = 0; i < 50; ++i) {
        const mat3 rotation = test::turned(0.3f + 0.1f * float(i), test::randomDirection(5u, i));
        const mat3 frame = directionFrame(room(rotation));
        expectOrthonormal(frame);
        for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(closestAxis(frame, rotation[axis]), 1.0f, 1e-5f) << i;
    }
}

TEST(DirectionFrame, isNotLedAstrayByFurniture) {
    const mat3 rotation = test::turned(0.5f, vec3(1, 2, 3));
    std::vector<vec3> faces = room(rotation);
    const std::vector<vec3> more = clutter(60.0f);
    faces.insert(faces.end(), more.begin(), more.end());
    const mat3 frame = directionFrame(faces);
    for (int axis = 0; axis < 3; ++axis) EXPECT_GT(closestAxis(frame, rotation[axis]), std::cos(0.02f));
}

TEST(DirectionFrame, isTheGridsWhereNoDirectionPrevails) {
    EXPECT_EQ(directionFrame(clutter(1.0f)), mat3(1.0f));
    EXPECT_EQ(directionFrame({}), mat3(1.0f));
    EXPECT_EQ(directionFrame(std::vector<vec3>{vec3(0.0f)}), mat3(1.0f));
    // A floor alone leaves the other axes open.
    EXPECT_EQ(directionFrame(std::vector<vec3>{vec3(1.0f, 2.0f, 0.0f)}), mat3(1.0f));
}

TEST(DirectionFrame, ignoresOnWhichSideOfAWallItsNormalLies) {
    const mat3 rotation = test::turned(0.4f, vec3(0, 1, 1));
    std::vector<vec3> inwards = room(rotation);
    for (vec3& face : inwards) face = -face;
    EXPECT_EQ(directionFrame(inwards), directionFrame(room(rotation)));
}

}  // namespace
}  // namespace clv
