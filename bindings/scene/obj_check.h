// Looks an .obj file and its material libraries over before assimp reads them, because assimp passes over damaged lines without a word.
#pragma once
#include <string>
#include <vector>

namespace clv {

// Returns warnings, a line each, of materials that no library has. Throws InputError that names the line: numbers that are none or that
// assimp misreads, faces with fewer than three corners or with corners that do not exist, material libraries that are missing.
std::vector<std::string> checkObj(const std::string& file);

}  // namespace clv
