// clv bake: the light of a scene as files of a volume.
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "bindings/cli/bake_light.h"
#include "bindings/cli/bake_motion.h"
#include "bindings/cli/command_line.h"
#include "bindings/cli/scene_facts.h"
#include "bindings/cli/staged_output.h"
#include "bindings/volume_file/volume_file.h"
#include "clv/plan/cascade_placement.h"

namespace clv {
namespace {

constexpr double kFramesPerSecond = 60.0;           // of the times in a series of still light
constexpr std::uint64_t kRaysOfAFrame = 256 << 10;  // where lights move

struct BakeCommand {
    CommonOptions common;
    SceneOptions scene;
    std::string out, motion;
    LightOptions light;
    CascadeOptions cascades;

    void checkMotion(const CLI::App& command) const {
        if (light.allBounces) throw InputError("--motion: all bounces of light that moves are not available; expected one bounce");
        if (common.backend == "vulkan") throw InputError("--motion: light that moves is computed on the CPU alone; expected --backend auto or cpu");
        for (const char* still : {"--seconds", "--cell-shift", "--proxy", "--device"})
            if (command.count(still) > 0) throw InputError(fmt::format("--motion: light that moves is not computed with {}; expected one of the two", still));
    }

    void check() const {
        const bool series = light.frames > 1;
        const std::string ending = series ? ".pvd" : ".vtm";
        if (std::filesystem::path(out).extension() != ending)
            throw InputError(fmt::format("--out {}: expected a name that ends in {} for {}", out, ending, series ? "a series of frames" : "a volume"));
        if (light.allBounces && series) throw InputError("--frames: a series of all bounces is not available; expected one frame or one bounce");
    }

    // As many frames as the motion has, and cascades for its camera, unless the options say how many.
    Motion motionOf(const Scene& loaded, const CLI::App& command) {
        const Motion read = loadMotion(motion, loaded);
        if (command.count("--frames") == 0) light.frames = read.lastFrame + 1;
        if (read.camera && cascades.count == 0) cascades.count = CascadeDesc{}.count;
        if (command.count("--rays") == 0) light.rays = kRaysOfAFrame;
        return read;
    }

    void run(const CLI::App& command) {
        Report report = startReport(command, common, true);
        Scene loaded = loadScene(scene, report);
        loaded.name = scene.scene;
        std::optional<Motion> moving;
        if (!motion.empty()) {
            checkMotion(command);
            moving = motionOf(loaded, command);
        }
        check();
        const std::filesystem::path path(out);
        StagedOutput output(path.has_parent_path() ? path.parent_path() : ".");
        const auto pathOf = [&](const std::string& name) { return output.path(name); };
        const std::string stem = path.stem().string();

        std::vector<SeriesStep> steps;
        Report written;
        const auto keep = [&](const BakedVolume& volume) {
            const std::string name = light.frames > 1 ? fmt::format("{}/frame_{:06}.vtm", stem, volume.frame) : stem + ".vtm";
            if (volume.frame == 0) steps.clear();
            steps.push_back({volume.frame / (moving ? moving->fps : kFramesPerSecond), name});
            writeVolume(name, volume, pathOf);
            written = cascadesOf(volume);
        };
        const ParallelFor parallelFor = parallelForOf(common);
        const PipelineReport run = moving ? bakeMotion(loaded, *moving, light, cascades, common.seed, parallelFor, keep)
                                          : bakeLight(loaded, light, bakeGrids(loaded, light, cascades), common.seed, parallelFor, keep);
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
    options->light.resolution = 32;
    command->get_option("--resolution")->description("A grid of about N^3 cells; of each cascade, cubes of N^3")->capture_default_str();
    command->add_option("--motion", options->motion, "A JSON file of lights and a camera that move, with as many frames unless --frames says otherwise; --rays are those of one frame, 256k unless given");
    addCascadeOptions(*command, options->cascades);
    addCommonOptions(*command, options->common);
    command->callback([options, command] {
        options->light.backend.choice = options->common.backend;
        options->run(*command);
    });
}

}  // namespace clv
