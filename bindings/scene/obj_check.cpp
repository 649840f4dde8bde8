#include "bindings/scene/obj_check.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>

#include "bindings/scene/file_bytes.h"
#include "bindings/scene/scene.h"

namespace clv {
namespace {

void checkVertex(const ObjLine& line, std::istringstream& words) {
    const std::vector<double> v = numbersOf(line, words, {3, 4, 6}, "a vertex of 3, 4 or 6 finite numbers");
    if (v.size() == 4 && v[3] == 0.0) line.fail("a weight that is not 0");
}

using Corner = std::array<long, 3>;  // of a vertex, texture coordinates and a normal, from 1; 0 where there is none
constexpr std::size_t kMostCorners = 16384;  // of a face: assimp takes time in their square to cut it
constexpr const char* kUnnamed = "default";  // the group of faces that stand in none
constexpr const char* kNames[] = {"vertices", "texture coordinates", "normals"};

// A corner is v, v/vt, v//vn or v/vt/vn; each counts from 1, or backwards from -1.
Corner readCorner(const ObjLine& line, const std::string& word, const Corner& counts) {
    Corner corner{};
    const char *at = word.data(), *end = at + word.size();
    for (std::size_t i = 0; i < corner.size(); ++i) {
        if (i == 0 || (at != end && *at != '/')) {
            const auto [after, error] = std::from_chars(at, end, corner[i]);
            if (error != std::errc() || (after != end && *after != '/')) break;
            at = after;
            if (corner[i] < 0) corner[i] += counts[i] + 1;
            if (corner[i] < 1 || corner[i] > counts[i]) line.fail(fmt::format("corners among the {} {} above, not '{}'", counts[i], kNames[i], word));
        }
        if (at == end) return corner;
        ++at;
    }
    line.fail(fmt::format("corners such as 1, 1/2, 1//3 or 1/2/3, not '{}'", word));
}

class ObjCheck {
public:
    explicit ObjCheck(const std::string& file) : file_(file) {}

    CheckedObj run() && {
        forEachObjLine(file_, [&](const ObjLine& line, const std::string& keyword, std::istringstream& words) { check(line, keyword, words); });
        if (checked_.parts.empty()) throw InputError(file_ + ": no faces; expected at least one triangle");
        checked_.materials = materials_.all();
        checked_.warnings = materials_.warnings();
        return std::move(checked_);
    }

private:
    void check(const ObjLine& line, const std::string& keyword, std::istringstream& words);
    void addLibraries(const ObjLine& line, const std::string& names);
    void addFace(const ObjLine& line, std::istringstream& words);
    // Begins a group of the text where the part is another one than that of the face before.
    void choosePart();
    void ignore(const std::string& feature) {
        if (std::ranges::find(checked_.ignored, feature) == checked_.ignored.end()) checked_.ignored.push_back(feature);
    }

    const std::string& file_;
    CheckedObj checked_;
    ObjMaterials materials_;
    Corner counts_{};
    std::string node_ = kUnnamed;
    std::optional<std::size_t> material_, part_;
    std::map<std::string, std::size_t> nodes_;
    std::map<ObjPart, std::size_t> parts_;
};

void ObjCheck::check(const ObjLine& line, const std::string& keyword, std::istringstream& words) {
    if (keyword == "v") {
        checkVertex(line, words);
        ++counts_[0];
    } else if (keyword == "vt") {
        numbersOf(line, words, {2, 3}, "texture coordinates of 2 or 3 finite numbers");
        ++counts_[1];
    } else if (keyword == "vn") {
        ++counts_[2];
    } else if (keyword == "f" || keyword == "fo") {
        addFace(line, words);
    } else if (keyword == "usemtl") {
        material_ = materials_.use(line, restOf(words));
    } else if (keyword == "o" || keyword == "g") {
        node_ = restOf(words);
        if (node_.empty()) node_ = kUnnamed;
    } else if (keyword == "mtllib") {
        addLibraries(line, restOf(words));
    } else if (keyword == "l" || keyword == "p") {
        ignore("points and lines");
    } else if (keyword == "curv" || keyword == "surf") {
        ignore("free-form curves and surfaces");
    }
    if (keyword == "v" || keyword == "vt") checked_.text += words.str() + '\n';
}

// A name, which may have blanks in it, or several without.
void ObjCheck::addLibraries(const ObjLine& line, const std::string& names) {
    const std::filesystem::path folder = std::filesystem::path(file_).parent_path();
    if (isFile(folder / names)) return materials_.addLibrary((folder / names).string());
    if (names.empty()) line.fail("a material library beside the file");
    std::istringstream words(names);
    for (std::string name; words >> name;) {
        if (!isFile(folder / name)) line.fail(fmt::format("a material library '{}' beside the file", names));
        materials_.addLibrary((folder / name).string());
    }
}

void ObjCheck::addFace(const ObjLine& line, std::istringstream& words) {
    std::vector<Corner> corners;
    for (std::string word; words >> word;) corners.push_back(readCorner(line, word, counts_));
    if (corners.size() < 3) line.fail("a face with three corners or more");
    if (corners.size() > kMostCorners) line.fail(fmt::format("a face with at most {} corners", kMostCorners));
    const bool hasUvs = corners[0][1] != 0;
    if (std::ranges::any_of(corners, [&](const Corner& corner) { return (corner[1] != 0) != hasUvs; }))
        line.fail("texture coordinates at all corners, or at none");
    if (!material_) material_ = materials_.useNone(line);
    choosePart();
    checked_.text += 'f';
    for (const Corner& corner : corners) {
        fmt::format_to(std::back_inserter(checked_.text), " {}", corner[0]);
        if (hasUvs) fmt::format_to(std::back_inserter(checked_.text), "/{}", corner[1]);
    }
    checked_.text += '\n';
}

void ObjCheck::choosePart() {
    const auto [node, isNewNode] = nodes_.try_emplace(node_, checked_.nodes.size());
    if (isNewNode) checked_.nodes.push_back(node_);
    const ObjPart wanted{node->second, *material_};
    const auto [part, isNew] = parts_.try_emplace(wanted, checked_.parts.size());
    if (isNew) checked_.parts.push_back(wanted);
    if (part_ != part->second) fmt::format_to(std::back_inserter(checked_.text), "g {}\n", part->second);
    part_ = part->second;
}

}  // namespace

CheckedObj checkObj(const std::string& file) { return ObjCheck(file).run(); }

}  // namespace clv
