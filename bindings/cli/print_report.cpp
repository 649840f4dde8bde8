#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bindings/cli/options.h"

namespace clv {
namespace {

std::string scalarText(const Report& value) {
    if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
    return value.is_string() ? value.get<std::string>() : value.dump();
}

bool isTable(const Report& value) {
    return value.is_array() && !value.empty() && value.front().is_object();
}

std::string cellText(const Report& value) {
    if (!value.is_array()) return scalarText(value);
    std::string text;
    for (const Report& element : value) text += (text.empty() ? "" : ", ") + scalarText(element);
    return text;
}

// Objects of the same keys, a line each, under a line of keys.
std::string tableText(const Report& rows, const std::string& indent) {
    std::vector<std::string> keys;
    std::vector<std::size_t> widths;
    for (const auto& [key, value] : rows.front().items()) {
        keys.push_back(key);
        widths.push_back(key.size());
        for (const Report& row : rows) widths.back() = std::max(widths.back(), cellText(row.at(key)).size());
    }
    std::string text;
    const auto addLine = [&](auto&& cell) {
        std::string line;
        for (std::size_t i = 0; i < keys.size(); ++i) line += fmt::format("{:<{}}  ", cell(keys[i]), widths[i]);
        text += indent + line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    };
    addLine([](const std::string& key) { return key; });
    for (const Report& row : rows) addLine([&](const std::string& key) { return cellText(row.at(key)); });
    return text;
}

std::string linesText(const Report& report, const std::string& indent) {
    std::size_t width = 0;
    for (const auto& [key, value] : report.items()) width = std::max(width, key.size());
    std::string text;
    for (const auto& [key, value] : report.items()) {
        if (value.is_object())
            text += indent + key + "\n" + linesText(value, indent + "  ");
        else if (isTable(value))
            text += indent + key + "\n" + tableText(value, indent + "  ");
        else
            text += fmt::format("{}{:<{}}  {}\n", indent, key, width, cellText(value));
    }
    return text;
}

}  // namespace

void printReport(const Report& report, const CommonOptions& options) {
    // Names in scene files need not be UTF-8, which JSON must be.
    const std::string text = options.json ? report.dump(2, ' ', false, Report::error_handler_t::replace) + "\n" : linesText(report, "");
    std::fputs(text.c_str(), stdout);
    if (std::fflush(stdout) != 0) throw std::runtime_error("stdout: cannot be written");
}

}  // namespace clv
