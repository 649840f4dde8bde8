// The scene's surfaces as a mesh that is fine enough to carry light at its vertices.
#pragma once
#include <vector>

#include "bindings/scene/scene.h"
#include "clv/stages/evaluate.h"

namespace clv {

struct SceneMesh {
    std::vector<glm::vec3> points;       // m
    std::vector<ClvReceiver> receivers;  // a point each, with the normal of the side that shows; a little inside the triangle, off its edges
    std::vector<glm::vec3> albedo;       // linear RGB, a point each
    std::vector<glm::uvec3> triangles;   // counter-clockwise on the side that shows
};

// Triangles are cut into equal parts until there are about `parts` of them; the backs follow the fronts where `backs`.
SceneMesh meshOf(const Scene& scene, std::size_t parts, bool backs);

}  // namespace clv
