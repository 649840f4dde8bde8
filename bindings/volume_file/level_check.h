// Whether the tables of a level hold together, so that nothing that reads it leaves them.
#pragma once
#include <string>

#include "clv/cpu/level.h"

namespace clv {

// What is wrong, in words; empty if nothing is. Each slot must belong to one cell, whose slots are neighbours in memory.
std::string problemOf(const Level& level);

}  // namespace clv
