// Files of what is not to be found twice.
#pragma once
#include <filesystem>
#include <string_view>

namespace clv {

// Whole or not at all: an interruption leaves what was there before. Throws std::runtime_error.
void keepFile(const std::filesystem::path& file, std::string_view bytes);

}  // namespace clv
