// Text into a file.
#pragma once
#include <string>
#include <string_view>

namespace clv {

// Throws std::runtime_error where not all of it is written, as on a full disk.
void writeText(const std::string& file, std::string_view text);

}  // namespace clv
