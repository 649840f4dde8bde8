// The same surfaces, of more triangles.
#pragma once
#include "bindings/scene/scene.h"

namespace clv {

// Each triangle is cut into four, `times` times over: the same surfaces of 4^times as many triangles, without materials.
inline Scene withSmallerTriangles(Scene scene, int times) {
    for (; times > 0; --times) {
        std::vector<glm::uvec3> smaller;
        for (const glm::uvec3& t : scene.triangles) {
            const auto middle = [&](std::uint32_t a, std::uint32_t b) {
                scene.positions.push_back(0.5f * (scene.positions[a] + scene.positions[b]));
                return std::uint32_t(scene.positions.size() - 1);
            };
            const std::uint32_t xy = middle(t.x, t.y), yz = middle(t.y, t.z), zx = middle(t.z, t.x);
            smaller.insert(smaller.end(), {{t.x, xy, zx}, {xy, t.y, yz}, {zx, yz, t.z}, {xy, yz, zx}});
        }
        scene.triangles = std::move(smaller);
    }
    scene.materials = {Material{}};
    scene.materialOf.assign(scene.triangles.size(), 0);
    scene.nodeOf.assign(scene.triangles.size(), 0);
    scene.uvs.clear();
    return scene;
}

}  // namespace clv
