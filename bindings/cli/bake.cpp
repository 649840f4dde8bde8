// clv bake: the light of a scene as files of a volume.
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "bindings/cli/bake_light.h"
#include "bindings/cli/command_line.h"
#include "bindings/cli/scene_facts.h"
#include "bindings/cli/staged_output.h"
#include "bindings/volume_file/volume_file.h"

namespace clv {
namespace {

constexpr double kFramesPerSecond = 60.0;  // of the times in a series

struct BakeCommand {
    CommonOptions common;
    SceneOptions scene;
    std::string out;
    LightOptions light;
    CascadeOptions cascades;

    void check() const {
        const bool series = light.frames > 1;
        const std::string ending = series ? ".pvd" : ".vtm";
        if (std::filesystem::path(out).extension() != ending)
            throw InputError(fmt::format("--out {}: expected a name that ends in {} for {}", out, ending, series ? "a series of frames" : "a volume"));
        if (light.allBounces && series) throw InputError("--frames: a series of all bounces is not available; expected one frame or one bounce");
        if (light.allBounces && cascades.count > 1) throw InputError("--cascades: all bounces in more than one are not available; expected one cascade or one bounce");
    }

    void run(const CLI::App& command) const {
        Report report = startReport(command, common, true);
        check();
        Scene loaded = loadScene(scene, report);
        loaded.name = scene.scene;
        const BakeGrids grids = bakeGrids(loaded, light, cascades);
        const std::filesystem::path path(out);
        StagedOutput output(path.has_parent_path() ? path.parent_path() : ".");
        const auto pathOf = [&](const std::string& name) { return output.path(name); };
        const std::string stem = path.stem().string();

        std::vector<SeriesStep> steps;
        Report written;
        const PipelineReport run = bakeLight(loaded, light, grids, common.seed, parallelForOf(common), [&](const BakedVolume& volume) {
            const std::string name = light.frames > 1 ? fmt::format("{}/frame_{:06}.vtm", stem, volume.frame) : stem + ".vtm";
            if (volume.frame == 0) steps.clear();
            steps.push_back({volume.frame / kFramesPerSecond, name});
            writeVolume(name, volume, pathOf);
            written = cascadesOf(volume);
        });
        if (light.frames > 1) writeSeries(stem + ".pvd", steps, pathOf);
        output.commit();

        report["bounces"] = light.allBounces ? "all" : "one";
        report["cascades"] = written;
        report["frames"] = steps.size();
        reportLight(run, report);
        report["out"] = out;
        printReport(report, common);
    }

    static Report cascadesOf(const BakedVolume& volume) {
        Report cascades = Report::array();
        for (const BakedCascade& cascade : volume.cascades) {
            const ClvVolume& grid = cascade.level.volume;
            cascades.push_back({{"resolution", {grid.resolution.x, grid.resolution.y, grid.resolution.z}}, {"cell_size", grid.cellSize}, {"slots", cascade.level.slots.size()}});
        }
        return cascades;
    }
};

}  // namespace

void addBakeCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand("bake", "Keep the light of a scene as a volume that ParaView opens");
    auto options = std::make_shared<BakeCommand>();
    addSceneOptions(*command, options->scene, true);
    command->add_option("--out", options->out, "V.vtm to write, beside a folder V with its pieces; V.pvd for a series of frames")->required();
    addLightOptions(*command, options->light);
    options->light.resolution = kResolutions[1];
    command->get_option("--resolution")->description("A grid of about N^3 cells; of each cascade, cubes of N^3")->capture_default_str();
    addCascadeOptions(*command, options->cascades);
    addCommonOptions(*command, options->common);
    command->callback([options, command] {
        options->light.backend.choice = options->common.backend;
        options->run(*command);
    });
}

}  // namespace clv
