// Cases of the formats that a history may be kept in.
#pragma once
#include "bindings/cli/stress/stress_case.h"

namespace clv {

std::vector<StressCase> historyFormatCases();

}  // namespace clv
