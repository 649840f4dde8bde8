// Whole files in and out of memory.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace clv {

// Also false where the name cannot be that of a file.
bool isFile(const std::filesystem::path& name);

// Throws InputError where there is none, or a folder.
void requireFile(const std::string& file);

// Throws InputError when the file cannot be read.
std::vector<std::uint8_t> readFileBytes(const std::string& file);

// Writes under a temporary name in the same folder, then renames: `file` is never half written. Throws InputError.
void writeFileBytes(const std::string& file, const std::vector<std::uint8_t>& bytes);

}  // namespace clv
