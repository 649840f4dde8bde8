// Numbers in a report's words.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

namespace clv {

std::string percentText(double fraction);     // "12.3 %"
std::string timeText(double seconds);         // "0.52 ms", "3.1 s"
std::string groupedText(double count);        // "921,600"
std::string countText(std::uint64_t count);   // "64k", "4M", as options take it
std::string bytesText(std::size_t bytes);     // "3.1 MiB"
// For HTML.
std::string escaped(const std::string& text);
std::string base64(const std::string& bytes);

}  // namespace clv
