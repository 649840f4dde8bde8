// Whole files in and out of memory.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace clv {

// Throws InputError when the file cannot be read.
std::vector<std::uint8_t> readFileBytes(const std::string& file);

// Writes under a temporary name in the same folder, then renames: `file` is never half written. Throws InputError.
void writeFileBytes(const std::string& file, const std::vector<std::uint8_t>& bytes);

}  // namespace clv
