// Scenes of a few triangles, for tests of what traces them.
#ifndef CLV_TESTS_EMBREE_SMALL_SCENES_H
#define CLV_TESTS_EMBREE_SMALL_SCENES_H
#include <vector>

#include "bindings/scene/scene_builder.h"
#include "bindings/scene/shapes.h"
#include "clv/data/ray.h"
#include "support/chi_square.h"

namespace clv::test {

// Builds a scene in which world space and the scene's own space are the same: tests then speak of one space only.
class SmallScene {
public:
    SmallScene() : builder_("test") { builder_.beginNode("node"); }

    std::uint32_t material(const glm::vec3& albedo) { return builder_.addMaterial({"", albedo, -1}); }
    // The rectangle `corner` + [0, 1] `x` + [0, 1] `y`; its front face looks along cross(x, y).
    void rectangle(const glm::dvec3& corner, const glm::dvec3& x, const glm::dvec3& y, std::uint32_t material) {
        builder_.addQuad(corner, corner + x, corner + x + y, corner + y, material);
    }
    void triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, std::uint32_t material) {
        builder_.addTriangle(builder_.addVertex(a), builder_.addVertex(b), builder_.addVertex(c), material);
    }
    void light(const ClvLight& light, const glm::dvec3& position = glm::dvec3(0.0)) { builder_.addLight("light", light, position); }

    Scene finish() {
        Scene scene = std::move(builder_).finish("test");
        const glm::vec3 shift(scene.anchor);
        for (glm::vec3& p : scene.positions) p += shift;
        for (NamedLight& light : scene.lights) light.light.position += shift;
        scene.bounds.lo += shift;
        scene.bounds.hi += shift;
        scene.anchor = glm::dvec3(0.0);
        return scene;
    }

private:
    SceneBuilder builder_;
};

// Triangles all over the box [-1, 1]^3 with edges of about `size`, m, each with an albedo of its own.
inline Scene triangleSoup(int count, float size, uint seed) {
    SmallScene scene;
    for (uint i = 0; i < uint(count); ++i) {
        const glm::vec3 center = 2.0f * glm::vec3(randomUnit(seed, 9 * i), randomUnit(seed, 9 * i + 1), randomUnit(seed, 9 * i + 2)) - 1.0f;
        scene.triangle(center + size * randomDirection(seed + 1, 3 * i), center + size * randomDirection(seed + 1, 3 * i + 1),
                       center + size * randomDirection(seed + 1, 3 * i + 2), scene.material(glm::vec3(randomUnit(seed + 2, i))));
    }
    return scene.finish();
}

inline ClvRay rayAlong(const glm::vec3& origin, const glm::vec3& direction, float maxDistance = kClvFar) {
    return {.origin = origin, .maxDistance = maxDistance, .direction = direction, .dynamicity = 0.0f, .flux = glm::vec3(1.0f), .pad0 = 0.0f};
}

// Rays from all over the box [-1, 1]^3 in all directions.
inline std::vector<ClvRay> randomRays(std::size_t count, uint seed, float maxDistance = kClvFar) {
    std::vector<ClvRay> rays;
    for (uint i = 0; i < count; ++i) {
        const glm::vec3 origin = 2.0f * glm::vec3(randomUnit(seed, 3 * i), randomUnit(seed, 3 * i + 1), randomUnit(seed, 3 * i + 2)) - 1.0f;
        rays.push_back(rayAlong(origin, randomDirection(seed + 1, i), maxDistance));
    }
    return rays;
}

}  // namespace clv::test
#endif
