// Looks an .obj file over before assimp reads it, because assimp passes over damaged lines without a word.
#pragma once
#include <string>

namespace clv {

// Throws InputError that names the line: vertices without three finite numbers, faces with fewer than three corners or with corners
// that do not exist, material libraries that are missing.
void checkObj(const std::string& file);

}  // namespace clv
