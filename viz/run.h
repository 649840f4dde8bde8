// clv-viz from its arguments to its exit status.
#pragma once

namespace clv {

// 0 on success, 1 on a failure at run time, 2 on bad usage or bad input. A failure is one line on stderr.
int runViz(int argc, const char* const* argv);

}  // namespace clv
