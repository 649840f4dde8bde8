// TBB behind the core's parallelFor.
#pragma once
#include "clv/cpu/parallel.h"

namespace clv {

// Runs on `threads` threads, the calling one among them; 0, or more than the machine has: on all of the machine's.
ParallelFor tbbParallelFor(int threads = 0);

}  // namespace clv
