// How a program ends: 0 on success, 1 on a failure at run time, 2 on bad usage or bad input, with one line on stderr that says why.
#pragma once
#include <functional>

namespace CLI {
class App;
}

namespace clv {

// Parses the command line, calls `work`, and returns the exit status. The line on stderr begins with the app and its command.
int exitStatusOf(CLI::App& app, int argc, const char* const* argv, const std::function<void()>& work);

}  // namespace clv
