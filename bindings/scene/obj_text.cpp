#include "bindings/scene/obj_text.h"

#include <algorithm>
#include <cctype>
#include <cfloat>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string_view>

#include <assimp/fast_atof.h>

#include "bindings/scene/file_bytes.h"
#include "bindings/scene/scene.h"

namespace clv {
namespace {

std::string_view trimmed(std::string_view line) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (line.starts_with('v') || line.starts_with('f') || line.starts_with('K') || line.starts_with('k')) line = line.substr(0, line.find('#'));
    return line.substr(0, line.find_last_not_of(" \t") + 1);
}

// Appends the line; assimp takes no number that begins with its point.
void append(std::string_view line, std::string& text) {
    const bool hasNumbers = line.starts_with('v') || line.starts_with('K') || line.starts_with('k');
    for (std::size_t i = 0; i < line.size(); ++i) {
        const bool begins = i > 0 && (line[i - 1] == ' ' || line[i - 1] == '\t');
        if (hasNumbers && begins && line[i] == '.') text += '0';
        text += line[i];
    }
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

// The file's lines without a byte order mark, blanks at both ends and comments behind numbers, and with a 0 before `.5`: assimp misreads all that. A line that goes on
// after a backslash is whole, and empty ones follow it, so that all keep their numbers.
std::string readObjText(const std::string& file) {
    const std::vector<std::uint8_t> bytes = readFileBytes(file);
    std::string_view rest(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3);
    std::string text, line, blankLines;
    for (std::size_t number = 1; !rest.empty(); ++number) {
        // Lines end in \n, \r\n or, in old files, in \r.
        const std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
        std::string_view piece = rest.substr(0, end);
        rest.remove_prefix(std::min(end + (rest.substr(end).starts_with("\r\n") ? 2 : 1), rest.size()));
        for (const char c : piece)
            if (c != '\t' && static_cast<unsigned char>(c) < 0x20) throw InputError(fmt::format("{}:{}: expected text, not control characters", file, number));
        const bool isComment = line.empty() && trimmed(piece).starts_with('#');
        const bool goesOn = piece.ends_with('\\') && !isComment;
        if (goesOn) piece.remove_suffix(1);
        line += piece;
        blankLines += '\n';
        if (goesOn && !rest.empty()) {
            line += ' ';
            continue;
        }
        append(trimmed(line), text);
        text += blankLines;
        line.clear();
        blankLines.clear();
    }
    return text;
}

}  // namespace

void ObjLine::fail(const std::string& expected) const { throw InputError(fmt::format("{}: expected {}", place(), expected)); }

void forEachObjLine(const std::string& file, const std::function<void(const ObjLine&, const std::string& keyword, std::istringstream& words)>& take) {
    std::istringstream text(readObjText(file));
    ObjLine line{file, 1};
    for (std::string content; std::getline(text, content); ++line.number) {
        std::istringstream words(content);
        std::string keyword;
        words >> keyword;
        take(line, keyword, words);
    }
}

std::string restOf(std::istringstream& words) {
    std::string name;
    std::getline(words >> std::ws, name);
    return name;
}

std::vector<double> numbersOf(const ObjLine& line, std::istringstream& words, std::initializer_list<std::size_t> counts, const char* expected) {
    std::vector<double> values;
    for (std::string word; words >> word;) {
        const std::optional<double> value = number(word);
        if (!value) line.fail(fmt::format("{} such as 0.5 or -1e3, not '{}'", expected, word));
        values.push_back(*value);
    }
    if (std::ranges::find(counts, values.size()) == counts.end()) line.fail(fmt::format("{}, not {}", expected, values.size()));
    return values;
}

}  // namespace clv
