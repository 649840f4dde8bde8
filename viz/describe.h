// A pick in words and numbers.
#pragma once
#include <string>

#include "viz/pick.h"

namespace clv {

// The cell at the picked position: index, cascade, place, six sides, dynamicity, counts; and for a surface, or a position with a normal,
// what it reads there, term by term.
std::string describe(const BakedVolume& volume, const Pick& pick, const LookupOptions& lookup);

// The same on stdout.
void printPick(const BakedVolume& volume, const Pick& pick, const LookupOptions& lookup);

}  // namespace clv
