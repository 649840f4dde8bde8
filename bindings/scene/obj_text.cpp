#include "bindings/scene/obj_text.h"

#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "bindings/scene/file_bytes.h"
#include "bindings/scene/scene.h"

namespace clv {
namespace {

std::string_view trimmed(std::string_view line) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (line.starts_with('v') || line.starts_with('f') || line.starts_with('K')) line = line.substr(0, line.find('#'));
    return line.substr(0, line.find_last_not_of(" \t") + 1);
}

// Appends the line; assimp takes no number that begins with its point.
void append(std::string_view line, std::string& text) {
    const bool hasNumbers = line.starts_with('v') || line.starts_with('K');
    for (std::size_t i = 0; i < line.size(); ++i) {
        const bool begins = i > 0 && (line[i - 1] == ' ' || line[i - 1] == '\t');
        if (hasNumbers && begins && line[i] == '.') text += '0';
        text += line[i];
    }
}

}  // namespace

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
        const bool goesOn = piece.ends_with('\\');
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

}  // namespace clv
