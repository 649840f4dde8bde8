#include "bindings/cli/command_line.h"

#include <algorithm>
#include <exception>
#include <iostream>
#include <new>
#include <string>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include "bindings/cli/standard_streams.h"
#include "bindings/scene/scene.h"

namespace clv {
namespace {

constexpr int kSuccess = 0;
constexpr int kRunTimeFailure = 1;
constexpr int kBadUsageOrInput = 2;

int fail(int status, const CLI::App& app, std::string message) {
    std::ranges::replace(message, '\n', ' ');
    std::string who = app.get_name();
    for (const CLI::App* command : app.get_subcommands()) who += " " + command->get_name();
    sayOnStderr(fmt::format("{}: {}", who, message));
    return status;
}

}  // namespace

int runCommandLine(int argc, const char* const* argv) {
    CLI::App app("Convergent light volumes: indirect diffuse light, in watts per square metre.", "clv");
    app.set_version_flag("--version", CLV_VERSION);
    app.require_subcommand(0, 1);
    addBakeCommand(app);
    addIrradianceCommand(app);
    addReferenceCommand(app);
    addRenderCommand(app);
    addPlanCommand(app);
    addReportCommand(app);
    addScenesCommand(app);
    addStressCommand(app);
    addInfoCommand(app);
    try {
        app.parse(argc, argv);
        // Asked for here: CLI11 would name the missing command before an argument that it does not know.
        if (app.get_subcommands().empty()) return fail(kBadUsageOrInput, app, "expected a command; see clv --help");
        return kSuccess;
    } catch (const CLI::Success& asked) {
        app.exit(asked);  // prints the help or the version
        return std::cout.flush() ? kSuccess : fail(kRunTimeFailure, app, "stdout: cannot be written");
    } catch (const CLI::Error& error) {
        return fail(kBadUsageOrInput, app, error.what());
    } catch (const InputError& error) {
        return fail(kBadUsageOrInput, app, error.what());
    } catch (const std::bad_alloc&) {
        return fail(kRunTimeFailure, app, "more memory is needed than there is; a smaller scene or picture, fewer points, lights or rays, or a lower --resolution need less");
    } catch (const std::exception& error) {
        return fail(kRunTimeFailure, app, error.what());
    }
}

}  // namespace clv
