#include "bindings/cli/point_table.h"

#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "bindings/cli/write_text.h"
#include "bindings/scene/reach.h"

namespace clv {
namespace {

constexpr std::string_view kHeader = "px,py,pz,nx,ny,nz";
constexpr std::size_t kColumns = 6;
constexpr double kUnitTolerance = 1e-3;
constexpr std::size_t kLongestLine = 4000;  // characters

std::string_view withoutCarriageReturn(std::string_view line) {
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// Reads one line; `place` is its file and line number.
std::array<double, kColumns> parseRow(std::string_view row, const std::string& place) {
    std::array<double, kColumns> values{};
    std::size_t column = 0;
    for (std::size_t begin = 0; begin <= row.size(); ++column) {
        const std::size_t end = std::min(row.find(',', begin), row.size());
        if (column < kColumns) {
            const std::string_view field = trimmed(row.substr(begin, end - begin));
            const auto [rest, error] = std::from_chars(field.data(), field.data() + field.size(), values[column]);
            if (error != std::errc() || rest != field.data() + field.size() || !std::isfinite(values[column]))
                throw InputError(fmt::format("{}: column {}: expected a finite number, found \"{}\"", place, column + 1, field));
        }
        begin = end + 1;
    }
    if (column != kColumns) throw InputError(fmt::format("{}: expected {} columns, {}, found {}", place, kColumns, kHeader, column));
    return values;
}

ReferencePoint pointFromRow(const std::array<double, kColumns>& row, const glm::dvec3& anchor, const std::string& place) {
    const glm::dvec3 position(row[0], row[1], row[2]);
    checkReach(position, place);
    const glm::dvec3 normal(row[3], row[4], row[5]);
    const double length = glm::length(normal);
    // Negated, so that a length that overflows is refused too.
    if (!(std::abs(length - 1.0) <= kUnitTolerance))
        throw InputError(fmt::format("{}: expected a normal of unit length, found length {:.6g}", place, length));
    return {glm::vec3(position - anchor), glm::vec3(normal / length)};
}

// Whether there was one. A line that never ends is refused before it takes all memory.
bool readLine(std::istream& input, std::string& line, const std::string& file, std::size_t number) {
    char text[kLongestLine + 1];
    input.getline(text, sizeof text);
    line.assign(text, std::size_t(input.gcount()) - (input.good() ? 1 : 0));
    if (input.fail() && input.gcount() == std::streamsize(kLongestLine)) throw InputError(fmt::format("{}:{}: expected at most {} characters", file, number, kLongestLine));
    return !input.fail();
}

}  // namespace

PointTable readPointTable(const std::string& file, const glm::dvec3& anchor) {
    std::ifstream input(file);
    if (!input || std::filesystem::is_directory(file)) throw InputError(fmt::format("{}: expected a file of points that can be read", file));

    std::string line;
    readLine(input, line, file, 1);
    std::string_view header = line;
    // Spreadsheets put a byte order mark in front of UTF-8.
    if (header.starts_with("\xef\xbb\xbf")) header.remove_prefix(3);
    if (withoutCarriageReturn(header) != kHeader) throw InputError(fmt::format("{}:1: expected the header {}", file, kHeader));

    PointTable table;
    for (std::size_t number = 2; readLine(input, line, file, number); ++number) {
        const std::string_view row = withoutCarriageReturn(line);
        if (row.empty()) continue;
        const std::string place = fmt::format("{}:{}", file, number);
        table.points.push_back(pointFromRow(parseRow(row, place), anchor, place));
        table.rows.emplace_back(row);
    }
    if (table.points.empty()) throw InputError(fmt::format("{}:2: expected at least one point below the header", file));
    return table;
}

void writePointTable(const std::string& file, const PointTable& table, std::initializer_list<PointColumns> columns) {
    fmt::memory_buffer text;
    const auto out = std::back_inserter(text);
    fmt::format_to(out, "{}", kHeader);
    for (const PointColumns& column : columns) fmt::format_to(out, ",{}", column.header);
    fmt::format_to(out, "\n");
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        fmt::format_to(out, "{}", table.rows[i]);
        for (const PointColumns& column : columns) {
            const glm::vec3& value = column.values[i];
            fmt::format_to(out, ",{},{},{}", value.x, value.y, value.z);
        }
        fmt::format_to(out, "\n");
    }
    writeText(file, {text.data(), text.size()});
}

}  // namespace clv
