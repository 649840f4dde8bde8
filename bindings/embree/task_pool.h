// TBB behind the core's parallelFor.
#pragma once
#include "clv/cpu/parallel.h"

namespace clv {

// Runs on `threads` threads (0: all of the machine's), the calling one among them.
ParallelFor tbbParallelFor(int threads = 0);

}  // namespace clv
