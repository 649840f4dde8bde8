// Looks an .obj file and its material libraries over before assimp reads what it knows without fault.
#pragma once
#include <string>
#include <vector>

#include "bindings/scene/obj_materials.h"

namespace clv {

struct CheckedObj {
    std::string text;  // an .obj file of vertices, texture coordinates, nodes and faces; usemtl gives the material's index
    std::vector<ObjMaterial> materials;
    std::vector<std::string> ignored;   // as of Scene
    std::vector<std::string> warnings;  // as of Scene
};

// Throws InputError that names the line: numbers that are none or that assimp misreads, faces with fewer than three corners or with corners that do not
// exist, material libraries that are missing or damaged.
CheckedObj checkObj(const std::string& file);

}  // namespace clv
