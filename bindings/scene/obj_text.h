// The text of .obj files and their material libraries.
#pragma once
#include <string>

namespace clv {

// The file's lines without a byte order mark, blanks at both ends and comments behind numbers, and with a 0 before `.5`: assimp misreads all that. A line that goes on
// after a backslash is whole, and empty ones follow it, so that all keep their numbers. Throws InputError.
std::string readObjText(const std::string& file);

}  // namespace clv
