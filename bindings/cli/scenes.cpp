// clv scenes: the built-in scenes, and their export.
#include <filesystem>
#include <memory>

#include "bindings/cli/command_line.h"
#include "bindings/cli/options.h"
#include "bindings/cli/staged_output.h"

#include <fmt/format.h>

namespace clv {
namespace {

constexpr const char* kExtension = ".glb";

struct ScenesCommand {
    CommonOptions common;
    std::string file;  // NAME.glb to write, or empty

    void run(const CLI::App& command) const {
        Report report = startReport(command, common);
        if (file.empty()) {
            report["scenes"] = Report::array();
            for (const BuiltinScene& builtin : builtinScenes()) report["scenes"].push_back(describe(builtin));
        } else {
            write(report);
        }
        printReport(report, common);
    }

private:
    static Report describe(const BuiltinScene& builtin) {
        const Scene scene = makeBuiltinScene(builtin.name);
        return {{"name", builtin.name},
                {"triangles", scene.triangles.size()},
                {"lights", scene.lights.size()},
                {"cameras", scene.cameras.size()},
                {"description", builtin.description}};
    }

    void write(Report& report) const {
        const std::filesystem::path path(file);
        if (path.extension() != kExtension) throw InputError(fmt::format("--write {}: expected the name of a scene and {}", file, kExtension));
        const Scene scene = makeBuiltinScene(path.stem().string());
        StagedFile output(path);
        writeGlb(scene, output.path());
        output.commit();
        report["scene"] = path.stem().string();
        report["triangles"] = scene.triangles.size();
        report["out"] = file;
    }
};

}  // namespace

void addScenesCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand("scenes", "List the built-in scenes, or write one as a file");
    auto options = std::make_shared<ScenesCommand>();
    command->add_option("--write", options->file, "Write the built-in scene NAME to the file NAME.glb, which may name a folder before it");
    addCommonOptions(*command, options->common);
    command->callback([options, command] { options->run(*command); });
}

}  // namespace clv
