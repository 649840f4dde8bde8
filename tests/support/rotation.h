// Rotations for tests of things that must not depend on how a scene is turned.
#ifndef CLV_TESTS_SUPPORT_ROTATION_H
#define CLV_TESTS_SUPPORT_ROTATION_H
#include <glm/gtc/matrix_transform.hpp>

namespace clv::test {

// By `angle`, rad, about an axis of any length.
inline glm::mat3 turned(float angle, const glm::vec3& axis) { return glm::mat3(glm::rotate(glm::mat4(1.0f), angle, axis)); }

}  // namespace clv::test
#endif
