// Cases of maps and rays.
#pragma once
#include <vector>

#include "benchmarks/gpu_run/stored.h"

namespace clv {

std::vector<StoredCase> rayCases();

}  // namespace clv
