#include "bindings/cli/exit_status.h"

#include <algorithm>
#include <exception>
#include <iostream>
#include <new>
#include <string>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include "bindings/cli/staged_output.h"
#include "bindings/cli/standard_streams.h"
#include "bindings/scene/scene.h"

namespace clv {
namespace {

constexpr int kSuccess = 0;
constexpr int kRunTimeFailure = 1;
constexpr int kBadUsageOrInput = 2;

int fail(int status, const CLI::App& app, const std::string& message) {
    std::string line = withFinalNames(message);
    std::ranges::replace(line, '\n', ' ');
    std::string who = app.get_name();
    for (const CLI::App* command : app.get_subcommands()) who += " " + command->get_name();
    sayOnStderr(fmt::format("{}: {}", who, line));
    return status;
}

}  // namespace

int exitStatusOf(CLI::App& app, int argc, const char* const* argv, const std::function<void()>& work) {
    try {
        app.parse(argc, argv);
        work();
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
