#include "bindings/scene/obj_check.h"

#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include <fmt/format.h>

#include "bindings/scene/file_bytes.h"
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

void checkVertex(const Line& line, std::istringstream& words) {
    std::string word;
    for (int i = 0; i < 3; ++i) {
        char* end = nullptr;
        const double value = words >> word ? std::strtod(word.c_str(), &end) : 0.0;
        if (!end || *end != '\0' || !std::isfinite(value)) line.fail("a vertex of three finite numbers");
    }
}

// A corner is v, v/vt, v//vn or v/vt/vn; v counts from 1, or backwards from -1.
void checkCorner(const Line& line, const std::string& corner, long vertices) {
    long index = 0;
    const auto [end, error] = std::from_chars(corner.data(), corner.data() + corner.size(), index);
    const bool isNumber = error == std::errc() && (end == corner.data() + corner.size() || *end == '/');
    const bool exists = index > 0 ? index <= vertices : index < 0 && -index <= vertices;
    if (!isNumber || !exists) line.fail(fmt::format("corners among the {} vertices above, not '{}'", vertices, corner));
}

// Reads a line together with those it goes on in after a backslash; returns how many it took.
std::size_t readLogicalLine(std::istream& text, std::string& content) {
    std::size_t lines = 0;
    content.clear();
    for (std::string piece; std::getline(text, piece);) {
        ++lines;
        if (!piece.empty() && piece.back() == '\r') piece.pop_back();
        const bool goesOn = !piece.empty() && piece.back() == '\\';
        if (goesOn) piece.back() = ' ';
        content += piece;
        if (!goesOn) break;
    }
    return lines;
}

}  // namespace

void checkObj(const std::string& file) {
    const std::vector<std::uint8_t> bytes = readFileBytes(file);
    std::istringstream text(std::string(bytes.begin(), bytes.end()));
    std::string content;
    long vertices = 0, faces = 0;
    Line line{file, 1};
    for (std::size_t taken; (taken = readLogicalLine(text, content)) > 0; line.number += taken) {
        std::istringstream words(content);
        std::string keyword, word;
        words >> keyword;
        if (keyword == "v") {
            checkVertex(line, words);
            ++vertices;
        } else if (keyword == "f") {
            int corners = 0;
            for (; words >> word; ++corners) checkCorner(line, word, vertices);
            if (corners < 3) line.fail("a face with three corners or more");
            ++faces;
        } else if (keyword == "mtllib") {
            std::getline(words >> std::ws, word);  // the name may hold spaces
            while (!word.empty() && std::isspace(static_cast<unsigned char>(word.back()))) word.pop_back();
            if (!std::filesystem::is_regular_file(std::filesystem::path(file).parent_path() / word))
                line.fail(fmt::format("a material library '{}' beside the file", word));
        }
    }
    if (faces == 0) throw InputError(file + ": no faces; expected at least one triangle");
}

}  // namespace clv
