// The command `clv`: its subcommands, and what their failures look like from outside.
#pragma once
#include <CLI/App.hpp>

namespace clv {

// Runs what the arguments ask for and returns the exit status: 0 on success, 1 on a failure at run time, 2 on bad usage or bad
// input. A failure is one line on stderr.
int runCommandLine(int argc, const char* const* argv);

// Each adds one subcommand that runs while the arguments are parsed.
void addBakeCommand(CLI::App& app);
void addInfoCommand(CLI::App& app);
void addIrradianceCommand(CLI::App& app);
void addPlanCommand(CLI::App& app);
void addReferenceCommand(CLI::App& app);
void addRenderCommand(CLI::App& app);
void addReportCommand(CLI::App& app);
void addScenesCommand(CLI::App& app);
void addStressCommand(CLI::App& app);

}  // namespace clv
