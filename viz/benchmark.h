// How fast a volume opens and turns, and how much memory that takes.
#pragma once
#include "viz/options.h"

namespace clv {

// Prints it, a line each. Throws InputError.
void benchmarkViewer(const VizOptions& options);

}  // namespace clv
