// The materials of an .obj file, out of its libraries.
#pragma once
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "bindings/scene/obj_text.h"

namespace clv {

struct ObjMaterial {
    std::string name = "default";
    std::string firstUse;             // file and line; empty where there is none
    std::string definition;           // file and line of its newmtl; empty where no library has it
    std::optional<glm::vec3> albedo;  // Kd, linear RGB in [0, 1]
    std::string picture;              // map_Kd; empty where there is none
};

class ObjMaterials {
public:
    // Reads newmtl, Kd and map_Kd, once of each library. Throws InputError that names the line.
    void addLibrary(const std::string& library);
    // Index of the material that a usemtl names, which a library may define later.
    std::size_t use(const ObjLine& line, const std::string& name);
    // Index of that of faces without a usemtl: it comes first.
    std::size_t useNone(const ObjLine& line);

    const std::vector<ObjMaterial>& all() const { return all_; }
    // Of materials that are not said, or twice, a line each.
    std::vector<std::string> warnings() const;

private:
    std::size_t indexOf(const std::string& name);
    std::size_t used(std::size_t index, const ObjLine& line);

    std::vector<ObjMaterial> all_ = std::vector<ObjMaterial>(1);
    std::map<std::string, std::size_t> indices_;  // of those with a name
    std::set<std::string> libraries_;
    std::vector<std::string> repetitions_;
};

}  // namespace clv
