#include "bindings/scene/obj_materials.h"

#include <algorithm>
#include <cctype>

#include "bindings/scene/scene.h"

namespace clv {
namespace {

std::string nameOf(const ObjLine& line, const std::string& name) {
    if (name.empty()) line.fail("the name of a material");
    return name;
}

glm::vec3 albedoOf(const ObjLine& line, std::istringstream& words) {
    const char* expected = "an albedo of 3 numbers from 0 to 1";
    const std::vector<double> rgb = numbersOf(line, words, {3}, expected);
    for (const double channel : rgb)
        if (!(float(channel) >= 0.0f && float(channel) <= 1.0f)) line.fail(fmt::format("{}, not {}", expected, channel));
    return {rgb[0], rgb[1], rgb[2]};
}

std::string pictureOf(const ObjLine& line, const std::string& name) {
    if (name.empty() || name.starts_with('-')) line.fail(fmt::format("the name of a picture without options, not '{}'", name));
    return name;
}

}  // namespace

std::size_t ObjMaterials::indexOf(const std::string& name) {
    const auto [known, isNew] = indices_.try_emplace(name, all_.size());
    if (isNew) all_.emplace_back().name = name;
    return known->second;
}

void ObjMaterials::addLibrary(const std::string& library) {
    if (!libraries_.insert(library).second) return;
    std::size_t current = 0;
    forEachObjLine(library, [&](const ObjLine& line, std::string keyword, std::istringstream& words) {
        std::ranges::transform(keyword, keyword.begin(), [](unsigned char c) { return char(std::tolower(c)); });
        if (keyword == "newmtl") {
            current = indexOf(nameOf(line, restOf(words)));
            ObjMaterial& material = all_[current];
            if (!material.definition.empty())
                repetitions_.push_back(fmt::format("{}: the material '{}' is defined above, too: what is said last counts", line.place(), material.name));
            material.definition = line.place();
        } else if (keyword == "kd" || keyword == "map_kd") {
            if (current == 0) line.fail("a newmtl above");
            if (keyword == "kd")
                all_[current].albedo = albedoOf(line, words);
            else
                all_[current].picture = pictureOf(line, restOf(words));
        }
    });
}

std::size_t ObjMaterials::use(const ObjLine& line, const std::string& name) { return used(indexOf(nameOf(line, name)), line); }

std::size_t ObjMaterials::useNone(const ObjLine& line) { return used(0, line); }

std::size_t ObjMaterials::used(std::size_t index, const ObjLine& line) {
    if (all_[index].firstUse.empty()) all_[index].firstUse = line.place();
    return index;
}

std::vector<std::string> ObjMaterials::warnings() const {
    std::vector<std::string> all = repetitions_;
    const auto warn = [&](const std::string& place, const std::string& what) { all.push_back(fmt::format("{}: {} an albedo of {}", place, what, Material().albedo.x)); };
    for (const ObjMaterial& material : all_) {
        if (material.firstUse.empty() || material.albedo || !material.picture.empty()) continue;
        if (&material == &all_[0])
            warn(material.firstUse, "no usemtl above: faces without a material have");
        else if (material.definition.empty())
            warn(material.firstUse, fmt::format("no library has the material '{}': its faces have", material.name));
        else
            warn(material.definition, fmt::format("no Kd or map_Kd: the material '{}' has", material.name));
    }
    return all;
}

}  // namespace clv
