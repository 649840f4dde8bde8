#include "bindings/scene/obj_check.h"

#include <algorithm>
#include <cctype>
#include <cfloat>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include <assimp/fast_atof.h>
#include <fmt/format.h>

#include "bindings/scene/file_bytes.h"
#include "bindings/scene/obj_text.h"
#include "bindings/scene/scene.h"

namespace clv {
namespace {

struct Line {
    const std::string& file;
    std::size_t number;
    [[noreturn]] void fail(const std::string& expected) const {
        throw InputError(fmt::format("{}:{}: expected {}", file, number, expected));
    }
};

// Calls `take` with each line's keyword and what follows it.
void forEachLine(const std::string& file, const std::function<void(const Line&, const std::string& keyword, std::istringstream& words)>& take) {
    std::istringstream text(readObjText(file));
    Line line{file, 1};
    for (std::string content; std::getline(text, content); ++line.number) {
        std::istringstream words(content);
        std::string keyword;
        words >> keyword;
        take(line, keyword, words);
    }
}

std::string restOf(std::istringstream& words) {
    std::string name;
    std::getline(words >> std::ws, name);  // may hold spaces
    return name;
}

// What assimp's reader of numbers throws here.
struct NotANumber {
    template <class... Words>
    explicit NotANumber(Words&&...) {}
};

// Nothing for what is no number, and for what assimp reads otherwise: of `0x10` it says that it is 0.
std::optional<double> number(const std::string& word) {
    constexpr double kMisread = 1e-5;
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    const bool beginsAsOne = std::isdigit(static_cast<unsigned char>(word[0])) || word[0] == '-' || word[0] == '+';
    if (!beginsAsOne || *end != '\0' || !std::isfinite(value)) return {};
    try {
        float read = 0.0f;
        Assimp::fast_atoreal_move<float, NotANumber>(word.c_str(), read);
        if (std::abs(double(read) - value) <= kMisread * std::abs(value) + FLT_MIN) return value;
    } catch (const NotANumber&) {
    }
    return {};
}

std::vector<double> numbers(const Line& line, std::istringstream& words, std::initializer_list<std::size_t> counts, const char* expected) {
    std::vector<double> values;
    for (std::string word; words >> word;) {
        const std::optional<double> value = number(word);
        if (!value) line.fail(fmt::format("{} such as 0.5 or -1e3, not '{}'", expected, word));
        values.push_back(*value);
    }
    if (std::ranges::find(counts, values.size()) == counts.end()) line.fail(fmt::format("{}, not {}", expected, values.size()));
    return values;
}

void checkVertex(const Line& line, std::istringstream& words) {
    const std::vector<double> v = numbers(line, words, {3, 4, 6}, "a vertex of 3, 4 or 6 finite numbers");
    if (v.size() == 4 && v[3] == 0.0) line.fail("a weight that is not 0");
}

// A corner is v, v/vt, v//vn or v/vt/vn; v counts from 1, or backwards from -1.
void checkCorner(const Line& line, const std::string& corner, long vertices) {
    long index = 0;
    const auto [end, error] = std::from_chars(corner.data(), corner.data() + corner.size(), index);
    const bool isNumber = error == std::errc() && (end == corner.data() + corner.size() || *end == '/');
    const bool exists = index > 0 ? index <= vertices : index < 0 && -index <= vertices;
    if (!isNumber || !exists) line.fail(fmt::format("corners among the {} vertices above, not '{}'", vertices, corner));
}

void addMaterialsOf(const std::string& library, std::set<std::string>& materials) {
    forEachLine(library, [&](const Line& line, const std::string& keyword, std::istringstream& words) {
        if (keyword == "newmtl") materials.insert(restOf(words));
        if (keyword == "Kd") numbers(line, words, {3}, "an albedo of 3 numbers");
    });
}

}  // namespace

std::vector<std::string> checkObj(const std::string& file) {
    long vertices = 0, faces = 0;
    std::set<std::string> materials;
    std::map<std::string, std::size_t> firstUse;  // of a material, its line
    forEachLine(file, [&](const Line& line, const std::string& keyword, std::istringstream& words) {
        if (keyword == "v") {
            checkVertex(line, words);
            ++vertices;
        } else if (keyword == "vt") {
            numbers(line, words, {2, 3}, "texture coordinates of 2 or 3 finite numbers");
        } else if (keyword == "f") {
            int corners = 0;
            for (std::string word; words >> word; ++corners) checkCorner(line, word, vertices);
            if (corners < 3) line.fail("a face with three corners or more");
            ++faces;
        } else if (keyword == "usemtl") {
            firstUse.try_emplace(restOf(words), line.number);
        } else if (keyword == "mtllib") {
            const std::string name = restOf(words);
            const std::filesystem::path library = std::filesystem::path(file).parent_path() / name;
            if (!isFile(library)) line.fail(fmt::format("a material library '{}' beside the file", name));
            addMaterialsOf(library.string(), materials);
        }
    });
    if (faces == 0) throw InputError(file + ": no faces; expected at least one triangle");
    std::vector<std::string> warnings;
    for (const auto& [name, line] : firstUse)
        if (!materials.contains(name)) warnings.push_back(fmt::format("{}:{}: no library has the material '{}': its faces have an albedo of 0.6", file, line, name));
    return warnings;
}

}  // namespace clv
