// Looks an .obj file and its material libraries over before assimp reads what it knows without fault.
#pragma once
#include <compare>
#include <string>
#include <vector>

#include "bindings/scene/obj_materials.h"

namespace clv {

// The faces of one object or group, whichever was named last, that have one material.
struct ObjPart {
    std::size_t node;
    std::size_t material;
    auto operator<=>(const ObjPart&) const = default;
};

struct CheckedObj {
    std::string text;                // an .obj file of vertices, texture coordinates, faces, and groups named by the index of their part
    std::vector<ObjPart> parts;      // in the order of their first faces
    std::vector<std::string> nodes;  // those that have faces, in the order of the first
    std::vector<ObjMaterial> materials;
    std::vector<std::string> ignored;   // as of Scene
    std::vector<std::string> warnings;  // as of Scene
};

// Throws InputError that names the line: numbers that are none or that assimp misreads, faces with fewer than three corners, more than 16,384, or corners that do not
// exist, material libraries that are missing or damaged.
CheckedObj checkObj(const std::string& file);

}  // namespace clv
