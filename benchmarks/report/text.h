// Numbers and measurements in a report's words.
#pragma once
#include <string>

#include "benchmarks/report/measurement.h"

namespace clv {

std::string percentText(double fraction);     // "12.3 %"
std::string timeText(double seconds);         // "0.52 ms", "3.1 s"
std::string countText(std::uint64_t count);   // "64k", "4M", as options take it
std::string bytesText(std::size_t bytes);     // "3.1 MiB"
// "path_tracing (a 1), 64k rays" and, where frames are merged, "16 frames of 64k rays".
std::string describe(const Measurement& m);
// For HTML.
std::string escaped(const std::string& text);
std::string base64(const std::string& bytes);

}  // namespace clv
