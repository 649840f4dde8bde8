// Files that end with a checksum of all that comes before, so that no damage goes unseen.
#pragma once
#include <string>

namespace clv {

// Appends the seal, an XML comment. Throws std::runtime_error.
void sealFile(const std::string& file);
// Throws InputError unless the file ends with its seal.
void checkSeal(const std::string& file);

}  // namespace clv
