#include "bindings/cli/command_line.h"

#include <CLI/App.hpp>

#include "bindings/cli/exit_status.h"
#include "bindings/scene/scene.h"

namespace clv {
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
    return exitStatusOf(app, argc, argv, [&] {
        // Asked for here: CLI11 would name the missing command before an argument that it does not know.
        if (app.get_subcommands().empty()) throw InputError("expected a command; see clv --help");
    });
}

}  // namespace clv
