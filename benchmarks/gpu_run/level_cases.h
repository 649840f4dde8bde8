// Cases of light in a level, and of what is read from it.
#pragma once
#include <vector>

#include "benchmarks/gpu_run/stored.h"

namespace clv {

std::vector<StoredCase> levelCases();

}  // namespace clv
