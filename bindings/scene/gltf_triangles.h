// The triangles of a glTF file's meshes, decoded by assimp.
#pragma once
#include <vector>

#include <glm/glm.hpp>

#include "bindings/scene/gltf_document.h"

namespace clv {

// One primitive of one mesh, in the space of the mesh.
struct GltfPrimitive {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec2> uvs;          // a vertex each; all zero when there are none
    std::vector<glm::uvec3> triangles;
};

// result[mesh][primitive]; points and lines come back empty. texCoordOfMaterial: the set that each material's base colour reads.
// Throws InputError.
std::vector<std::vector<GltfPrimitive>> decodeTriangles(const GltfDocument& document, const std::vector<std::size_t>& texCoordOfMaterial);

}  // namespace clv
